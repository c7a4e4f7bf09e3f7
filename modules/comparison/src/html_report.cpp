#include "oneac/comparison/html_report.h"

#include "oneac/base/number_text.h"
#include "oneac/geometry/angles.h"
#include "oneac/report/cdf.h"
#include "oneac/report/html_page.h"

#include <algorithm>
#include <limits>

namespace oneac {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// Rows of the drill-down; beyond it a browser grows slow, and pairs.csv has them all.
constexpr std::size_t kMostPairs = 400;
constexpr double kPixel = 0.005;  // of a share: a pixel of the plot

/// One quantity of every estimate, method by method.
template <class Value>
Plot plot_of(const ComparisonData& data, const char* title, const char* x_label, Value&& value) {
  std::vector<Sample> samples;
  for (const std::string& method : data.methods) samples.push_back({method, {}});
  for (const PairRecord& pair : data.pairs) {
    for (const MethodResult& result : pair.results) {
      const std::optional<double> x = value(pair, result);
      if (x) samples[result.method].values.push_back(*x);
    }
  }
  Plot plot = cdf_plot(title, x_label, samples);
  plot.legend = false;
  return plot;
}

bool is_moving(const PairRecord& pair) {
  return pair.truth && pair.truth->t.norm() > 0.1;  // as kSmallestTrueStep
}

std::vector<Plot> plots_of(const ComparisonData& data) {
  using Value = std::optional<double>;
  const auto rotation = [](const PairRecord& p, const MethodResult& r) -> Value {
    if (!p.truth) return std::nullopt;
    return r.has_pose ? *error_of(p, r).rotation / kDegree : kInfinite;
  };
  const auto direction = [](const PairRecord& p, const MethodResult& r) -> Value {
    if (!is_moving(p)) return std::nullopt;
    const auto error = error_of(p, r).direction;
    return error ? *error / kDegree : kInfinite;
  };
  const auto time = [](const PairRecord&, const MethodResult& r) -> Value { return r.ms; };
  const auto iterations = [](const PairRecord&, const MethodResult& r) -> Value {
    if (r.iterations == 0) return std::nullopt;  // not told
    return static_cast<double>(r.iterations);
  };
  return {plot_of(data, "Rotation error", "degrees", rotation),
          plot_of(data, "Translation error", "degrees", direction),
          plot_of(data, "Time", "ms of one thread", time),
          plot_of(data, "Iterations", "iterations", iterations)};
}

void add_plots(HtmlPage& page, const ComparisonData& data) {
  page.heading("Cumulative distributions");
  page.legend(data.methods);
  const std::vector<Plot> plots = plots_of(data);
  std::vector<std::string> svgs;
  for (const Plot& plot : plots) svgs.push_back(plot_svg(plot));
  page.figures(svgs);
  for (const Plot& plot : plots) {
    for (const auto& group : coinciding(plot, kPixel)) {
      std::string names = group.front();
      for (std::size_t i = 1; i < group.size(); ++i) {
        names += (i + 1 == group.size() ? " and " : ", ") + group[i];
      }
      if (group.size() == data.methods.size()) names = "all methods";
      page.paragraph(plot.title + ": the curves of " + names + " lie on each other.");
    }
  }
}

Table table_of(const TableBlock& block) {
  Table table{"", {block.title}, {}};
  table.head.insert(table.head.end(), block.logs.begin(), block.logs.end());
  for (std::size_t m = 0; m < block.methods.size(); ++m) {
    table.rows.push_back({{block.methods[m]}});
    for (std::size_t log = 0; log < block.logs.size(); ++log) {
      table.rows.back().push_back(cell_of(block, m, log));
    }
  }
  return table;
}

/// The last column of every block beside each other: the logs' average, or the only log.
Table overview(const std::vector<TableBlock>& blocks) {
  const std::size_t last = blocks.front().logs.size() - 1;
  Table table{"", {blocks.front().logs[last]}, {}};
  for (const TableBlock& block : blocks) table.head.push_back(block.title);
  for (std::size_t m = 0; m < blocks.front().methods.size(); ++m) {
    table.rows.push_back({{blocks.front().methods[m]}});
    for (const TableBlock& block : blocks) table.rows.back().push_back(cell_of(block, m, last));
  }
  return table;
}

void add_tables(HtmlPage& page, const std::vector<TableBlock>& blocks) {
  page.heading("Table");
  if (blocks.empty()) {
    page.paragraph("No pair was compared.");
    return;
  }
  page.table(overview(blocks));
  if (blocks.front().logs.size() < 2) return;
  page.begin_details("Log by log");
  for (const TableBlock& block : blocks) page.table(table_of(block));
  page.end_details();
}

std::string log_sentence(const LogRecord& log) {
  std::string text = log.name + ": " + std::to_string(log.pairs) +
                     " pairs of consecutive images; camera pitched up " +
                     fixed_text(log.tilt.pitch_up / kDegree, 2) + "°, leaning right " +
                     fixed_text(log.tilt.roll_right / kDegree, 2) + "°; ";
  if (log.reference == "none") return text + "no reference, so no errors.";
  if (log.reference != "GPS course") {
    return text + "reference: " + log.reference + ".";
  }
  text += "reference: change of the GPS course, interpolated. A course is good to " +
          fixed_text(log.course_sigma_deg, 2) + "° (1σ), the turn of a pair to " +
          fixed_text(log.heading_sigma_deg, 2) + "°";
  if (log.heading_vs_gyro_deg > 0.0) {
    text += "; it differs from the gyroscope by " + fixed_text(log.heading_vs_gyro_deg, 2) +
            "° (root mean square)";
  }
  return text + ". Errors below that are the reference's. It knows no direction of travel.";
}

Cell error_cell(const PairRecord& pair, const MethodResult& result) {
  const ResultError error = error_of(pair, result);
  Cell cell{"no pose", error.failed ? Cell::Mark::kBad : Cell::Mark::kNone};
  if (!result.has_pose) return cell;
  cell.text = error.rotation ? three_digits(*error.rotation / kDegree) + "°" : result.status;
  if (error.rotation && error.direction) {
    cell.text += " / " + three_digits(*error.direction / kDegree) + "°";
  }
  return cell;
}

std::string name_of(const ComparisonData& data, const PairRecord& pair) {
  return name_of_log(data, pair.log) + " " + std::to_string(pair.index1) + "–" +
         std::to_string(pair.index2);
}

/// First trial of every method on the given pairs.
Table pair_table(const ComparisonData& data, const std::vector<std::size_t>& pairs) {
  Table table{"", {"pair", "ACs"}, {}};
  table.head.insert(table.head.end(), data.methods.begin(), data.methods.end());
  for (const std::size_t i : pairs) {
    const PairRecord& pair = data.pairs[i];
    table.rows.push_back({{name_of(data, pair)}, {std::to_string(pair.acs)}});
    for (const MethodResult& result : pair.results) {
      if (result.trial == 0) table.rows.back().push_back(error_cell(pair, result));
    }
  }
  return table;
}

bool is_bad(const ComparisonData& data, const PairOverlay& overlay) {
  const PairRecord& pair = data.pairs[overlay.pair];
  return std::any_of(pair.results.begin(), pair.results.end(), [&](const MethodResult& result) {
    return result.method == overlay.method && error_of(pair, result).failed;
  });
}

void add_pairs(HtmlPage& page, const ComparisonData& data,
               const std::vector<PairOverlay>& overlays) {
  if (data.pairs.empty()) return;
  const std::string& method = data.methods[shown_method(data)];
  const bool bad = std::any_of(overlays.begin(), overlays.end(),
                               [&](const PairOverlay& overlay) { return is_bad(data, overlay); });
  page.heading((bad ? "Worst pairs of " : "Pairs of ") + method);
  if (!bad) page.paragraph("None failed; the least good come first.");
  page.paragraph(
      "Errors: rotation / direction of translation, first trial; red: rotation off by more than "
      "1° or direction by more than 15°. Blue: inliers, orange: the others. A line runs from where "
      "a point was to where it is, its frame is what the affinity makes of a square.");
  for (const PairOverlay& overlay : overlays) {
    page.picture(
        name_of(data, data.pairs[overlay.pair]) + ", inliers of " + data.methods[overlay.method],
        overlay_svg(overlay.picture));
    page.table(pair_table(data, {overlay.pair}));
  }
  const auto order = worst_pairs(data, shown_method(data), kMostPairs);
  const std::string which = order.size() < data.pairs.size()
                                ? "The worst " + std::to_string(order.size()) + " of " +
                                      std::to_string(data.pairs.size()) + " pairs"
                                : "All " + std::to_string(order.size()) + " pairs";
  page.begin_details(which + ", the worst first");
  page.table(pair_table(data, order));
  page.end_details();
}

}  // namespace

std::string html_report(const ComparisonData& data, const std::vector<MethodSummary>& summary,
                        const std::vector<PairOverlay>& overlays,
                        const std::vector<std::string>& notes) {
  HtmlPage page("Initialisers compared", std::to_string(data.methods.size()) + " methods, " +
                                             std::to_string(data.pairs.size()) + " pairs, " +
                                             std::to_string(data.trials) +
                                             (data.trials == 1 ? " trial each" : " trials each") +
                                             "; every method is given the same correspondences.");
  for (const LogRecord& log : data.logs) page.paragraph(log_sentence(log));
  for (const std::string& note : notes) page.warning(note);
  add_plots(page, data);
  add_tables(page, table_blocks(summary));
  add_pairs(page, data, overlays);
  return page.text();
}

}  // namespace oneac
