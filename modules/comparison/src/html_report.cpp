#include "oneac/comparison/html_report.h"

#include "page_style.h"
#include "text.h"

#include "oneac/comparison/plots.h"
#include "oneac/evaluation/html_page.h"
#include "oneac/geometry/angles.h"

#include <algorithm>
#include <limits>

namespace oneac {
namespace {

using internal::decimals;
using internal::three_digits;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// Rows of the drill-down; beyond it a browser grows slow, and pairs.csv has them all.
constexpr std::size_t kMostPairs = 400;

std::string name_of_log(const ComparisonData& data, std::size_t log) {
  for (const LogRecord& record : data.logs) {
    if (record.log == log) return record.name;
  }
  return "";
}

/// One quantity of every estimate, method by method.
template <class Value>
CdfPlot plot_of(const ComparisonData& data, const char* title, const char* x_label, Value&& value) {
  CdfPlot plot;
  plot.title = title;
  plot.x_label = x_label;
  for (const std::string& method : data.methods) plot.curves.push_back({method, {}});
  for (const PairRecord& pair : data.pairs) {
    for (const MethodResult& result : pair.results) {
      const std::optional<double> x = value(pair, result);
      if (x) plot.curves[result.method].values.push_back(*x);
    }
  }
  return plot;
}

bool is_moving(const PairRecord& pair) {
  return pair.truth && pair.truth->t.norm() > 0.1;  // as kSmallestTrueStep
}

std::string plots(const ComparisonData& data) {
  using Value = std::optional<double>;
  const auto rotation = plot_of(
      data, "Rotation error", "degrees", [](const PairRecord& p, const MethodResult& r) -> Value {
        if (!p.truth) return std::nullopt;
        return r.has_pose ? *error_of(p, r).rotation / kDegree : kInfinite;
      });
  const auto direction = plot_of(data, "Translation error", "degrees",
                                 [](const PairRecord& p, const MethodResult& r) -> Value {
                                   if (!is_moving(p)) return std::nullopt;
                                   const auto error = error_of(p, r).direction;
                                   return error ? *error / kDegree : kInfinite;
                                 });
  const auto time = plot_of(data, "Time", "ms of one thread",
                            [](const PairRecord&, const MethodResult& r) -> Value { return r.ms; });
  auto iterations = plot_of(data, "Iterations", "log10 of the iterations",
                            [](const PairRecord&, const MethodResult& r) -> Value {
                              if (r.iterations == 0) return std::nullopt;  // not told
                              return static_cast<double>(r.iterations);
                            });
  iterations.show_exponent = true;
  return "<div class=\"plots\">\n" + cdf_svg(rotation) + cdf_svg(direction) + cdf_svg(time) +
         cdf_svg(iterations) + "</div>\n";
}

std::string legend(const ComparisonData& data) {
  std::string html = "<div class=\"legend\">\n";
  for (std::size_t m = 0; m < data.methods.size(); ++m) {
    const std::string number = std::to_string(m);
    html += "<label><input type=\"checkbox\" checked data-curve=\"m" + number +
            "\"><svg viewBox=\"0 0 30 10\"><path class=\"curve c" + std::to_string(m % 10) + " d" +
            std::to_string(m / 10 % 4) + "\" d=\"M0 5H30\"/></svg>" +
            html_escaped(data.methods[m]) + "</label>\n";
  }
  return html + "</div>\n";
}

std::string table(const TableBlock& block) {
  std::string html = "<table><tr><th class=\"name\">" + html_escaped(block.title) + "</th>";
  for (const std::string& log : block.logs) html += "<th>" + html_escaped(log) + "</th>";
  html += "</tr>\n";
  for (std::size_t m = 0; m < block.methods.size(); ++m) {
    html += "<tr><td class=\"name\">" + html_escaped(block.methods[m]) + "</td>";
    for (std::size_t log = 0; log < block.logs.size(); ++log) {
      html += block.best[m][log] ? "<td class=\"best\">" : "<td>";
      html += block.cells[m][log] + "</td>";
    }
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

/// The last column of every block beside each other: the logs' average, or the only log.
std::string overview(const std::vector<TableBlock>& blocks) {
  if (blocks.empty()) return "<p>No pair was compared.</p>\n";
  std::string html = "<div class=\"scroll\"><table><tr><th class=\"name\">" +
                     html_escaped(blocks.front().logs.back()) + "</th>";
  for (const TableBlock& block : blocks) html += "<th>" + html_escaped(block.title) + "</th>";
  html += "</tr>\n";
  for (std::size_t m = 0; m < blocks.front().methods.size(); ++m) {
    html += "<tr><td class=\"name\">" + html_escaped(blocks.front().methods[m]) + "</td>";
    for (const TableBlock& block : blocks) {
      html += block.best[m].back() ? "<td class=\"best\">" : "<td>";
      html += block.cells[m].back() + "</td>";
    }
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

std::string log_sentence(const LogRecord& log) {
  std::string text = "<b>" + html_escaped(log.name) + "</b>: " + std::to_string(log.pairs) +
                     " pairs of consecutive images; camera pitched up " +
                     decimals(log.tilt.pitch_up / kDegree, 2) + "°, leaning right " +
                     decimals(log.tilt.roll_right / kDegree, 2) + "°; ";
  if (log.reference == "none") return text + "no reference, so no errors.";
  if (log.reference != "GPS course") {
    return text + "reference: " + html_escaped(log.reference) + ".";
  }
  text += "reference: change of the GPS course, interpolated. A course is good to " +
          decimals(log.course_sigma_deg, 2) + "° (1σ), the turn of a pair to " +
          decimals(log.heading_sigma_deg, 2) + "°";
  if (log.heading_vs_gyro_deg > 0.0) {
    text += "; it differs from the gyroscope by " + decimals(log.heading_vs_gyro_deg, 2) +
            "° (root mean square)";
  }
  return text + ". Errors below that are the reference's. It knows no direction of travel.";
}

std::string error_cell(const PairRecord& pair, const MethodResult& result) {
  const ResultError error = error_of(pair, result);
  std::string html = error.failed ? "<td class=\"bad\">" : "<td>";
  if (!result.has_pose) return html + "no pose</td>";
  if (!error.rotation) return html + html_escaped(result.status) + "</td>";
  html += three_digits(*error.rotation / kDegree) + "°";
  if (error.direction) html += " / " + three_digits(*error.direction / kDegree) + "°";
  return html + "</td>";
}

/// First trial of every method on the given pairs.
std::string pair_rows(const ComparisonData& data, const std::vector<std::size_t>& pairs) {
  std::string html = "<div class=\"scroll\"><table><tr><th class=\"name\">pair</th><th>ACs</th>";
  for (const std::string& method : data.methods) html += "<th>" + html_escaped(method) + "</th>";
  html += "</tr>\n";
  for (const std::size_t i : pairs) {
    const PairRecord& pair = data.pairs[i];
    html += "<tr><td class=\"name\">" + html_escaped(name_of_log(data, pair.log)) + " " +
            std::to_string(pair.index1) + "–" + std::to_string(pair.index2) + "</td><td>" +
            std::to_string(pair.acs) + "</td>";
    for (const MethodResult& result : pair.results) {
      if (result.trial == 0) html += error_cell(pair, result);
    }
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

std::string figure(const ComparisonData& data, const PairOverlay& overlay) {
  const PairRecord& pair = data.pairs[overlay.pair];
  return "<figure><figcaption><b>" + html_escaped(name_of_log(data, pair.log)) + " " +
         std::to_string(pair.index1) + "–" + std::to_string(pair.index2) + "</b>, inliers of " +
         html_escaped(data.methods[overlay.method]) + "</figcaption><img alt=\"motion of the " +
         "correspondences over the second image\" src=\"data:image/jpeg;base64," +
         overlay.jpeg_base64 + "\">" + pair_rows(data, {overlay.pair}) + "</figure>\n";
}

std::string drill_down(const ComparisonData& data, const std::vector<PairOverlay>& overlays) {
  if (data.pairs.empty()) return "";
  const std::string method = html_escaped(data.methods[shown_method(data)]);
  std::string html = "<h2>Worst pairs of " + method + "</h2>\n";
  html +=
      "<p class=\"dim\">Errors: rotation / direction of translation, first trial; red: rotation "
      "off by more than 1° or direction by more than 15°. Blue: inliers, orange: the others, "
      "from where the point was in the first image.</p>\n";
  for (const PairOverlay& overlay : overlays) html += figure(data, overlay);
  const auto order = worst_pairs(data, shown_method(data), kMostPairs);
  const std::string which = order.size() < data.pairs.size()
                                ? "The worst " + std::to_string(order.size()) + " of " +
                                      std::to_string(data.pairs.size()) + " pairs"
                                : "All " + std::to_string(order.size()) + " pairs";
  return html + "<details><summary>" + which + ", the worst first</summary>\n" +
         pair_rows(data, order) + "</details>\n";
}

}  // namespace

std::string html_report(const ComparisonData& data, const std::vector<MethodSummary>& summary,
                        const std::vector<PairOverlay>& overlays,
                        const std::vector<std::string>& notes) {
  const std::vector<TableBlock> blocks = table_blocks(summary);
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width,initial-scale=1\">\n<title>oneac compare</title>\n<style>" +
      std::string(internal::kPageStyle) + "</style></head><body>\n<h1>Initialisers compared</h1>\n";
  html += "<p class=\"dim\">" + std::to_string(data.methods.size()) + " methods, " +
          std::to_string(data.pairs.size()) + " pairs, " + std::to_string(data.trials) +
          (data.trials == 1 ? " trial each" : " trials each") +
          "; every method is given the same correspondences.</p>\n";
  for (const LogRecord& log : data.logs) html += "<p>" + log_sentence(log) + "</p>\n";
  for (const std::string& note : notes) html += "<p><b>" + html_escaped(note) + "</b></p>\n";
  html += "<h2>Cumulative distributions</h2>\n" + legend(data) + plots(data);
  html += "<h2>Table</h2>\n" + overview(blocks);
  if (!blocks.empty() && blocks.front().logs.size() > 1) {
    html += "<details><summary>Log by log</summary><div class=\"scroll\">\n";
    for (const TableBlock& block : blocks) html += table(block);
    html += "</div></details>\n";
  }
  html += drill_down(data, overlays);
  return html + "<script>" + internal::kPageScript + "</script>\n</body></html>\n";
}

}  // namespace oneac
