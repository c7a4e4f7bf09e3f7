#include "run_report.h"

#include "run_curves.h"
#include "run_outputs.h"
#include "worst_frames.h"

#include "oneac/base/number_text.h"
#include "oneac/base/version.h"
#include "oneac/report/html_page.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace oneac::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kPictures = 6;
constexpr int kDigits = 5;  // significant ones in the tables; summary.json has them all

std::string value_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return significant_text(value.get<double>(), kDigits);
  if (value.is_null()) return "–";
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string words(std::string key) {
  std::replace(key.begin(), key.end(), '_', ' ');
  return key;
}

/// The values below, named by their way there.
void flatten(const Json& json, const std::string& prefix, HtmlPage::Rows& rows) {
  for (const auto& [key, value] : json.items()) {
    const std::string name = prefix.empty() ? words(key) : prefix + " · " + words(key);
    if (value.is_object()) {
      flatten(value, name, rows);
    } else if (!value.is_array()) {
      rows.emplace_back(name, value_text(value));
    }
  }
}

void add_table(HtmlPage& page, const std::string& caption, const Json& json) {
  HtmlPage::Rows rows;
  flatten(json, "", rows);
  if (!rows.empty()) page.table(caption, rows);
}

bool is_empty_text(const Json& value) {
  return value.is_string() && value.get_ref<const std::string&>().empty();
}

/// Scalars first, then a table per object; timing has its own section.
void add_tables(HtmlPage& page, const Json& summary) {
  Json scalars = Json::object();
  for (const auto& [key, value] : summary.items()) {
    if (!value.is_structured() && !is_empty_text(value)) scalars[key] = value;
  }
  page.begin_group();
  add_table(page, "run", scalars);
  for (const auto& [key, value] : summary.items()) {
    if (value.is_object() && key != "timing") add_table(page, words(key), value);
  }
  page.end_group();
}

HtmlPage::Rows tiles_of(const DriveRecord& record, const RunEvaluation& evaluation,
                        const Json& summary) {
  HtmlPage::Rows tiles;
  const bool scaled = record.has_scale();
  tiles.emplace_back("frames", std::to_string(record.frames.size()));
  tiles.emplace_back(scaled ? "path [m]" : "path [units]", value_text(summary["path_length"]));
  tiles.emplace_back("steps in metres", value_text(summary["metric"]));
  if (!evaluation.against_poses) return tiles;
  const auto& trajectory = evaluation.against_poses->trajectory;
  if (trajectory) {
    tiles.emplace_back("APE, RMS [m]", significant_text(trajectory->ape.rmse, 3));
    if (trajectory->subsequences) {
      tiles.emplace_back("t_rel [%]",
                         significant_text(100.0 * trajectory->subsequences->translation, 3));
      tiles.emplace_back(
          "r_rel [deg/100 m]",
          significant_text(100.0 * trajectory->subsequences->rotation * 180.0 / M_PI, 3));
    }
    if (trajectory->scale_error && scaled) {
      tiles.emplace_back("scale error [%]", significant_text(100.0 * *trajectory->scale_error, 3));
    }
  }
  return tiles;
}

void add_warnings(HtmlPage& page, const DriveRecord& record) {
  if (record.interrupted) page.warning("The run was interrupted; this is what it had by then.");
  if (!record.failure.empty()) page.warning("Stopped early: " + record.failure);
  if (!record.source.damage.empty()) page.warning("The log is damaged: " + record.source.damage);
  for (const std::string& note : notes_about(record)) page.warning(note);
}

void add_curves(HtmlPage& page, const DriveRecord& record, const RunEvaluation& evaluation) {
  page.heading("The drive");
  std::vector<std::string> svgs = {plot_svg(plan_of(record, evaluation))};
  page.figures(svgs);
  svgs.clear();
  for (const Plot& plot : plots_of(record, evaluation)) svgs.push_back(plot_svg(plot));
  page.figures(svgs);
}

/// Absolute position errors of the drive as it was and as it is closed.
Table ape_of_loops(const RunEvaluation& evaluation) {
  Table table{"Absolute position error against the reference [m]",
              {"trajectory", "RMS", "mean", "median", "95 %", "largest", "length [%]"},
              {}};
  const auto add = [&](const char* name, const std::optional<Evaluation>& of) {
    if (!of || !of->trajectory) return;
    const Statistics& ape = of->trajectory->ape;
    std::vector<Cell> row{{name}};
    for (const double value : {ape.rmse, ape.mean, ape.median, ape.p95, ape.max}) {
      row.push_back({significant_text(value, 3)});
    }
    const std::optional<double> scale = of->trajectory->scale_error;
    row.push_back({scale ? significant_text(100.0 * *scale, 2) : ""});
    table.rows.push_back(row);
  };
  add("odometry", evaluation.against_poses);
  add("loops, pose graph", evaluation.graph_against_poses);
  const bool adjusted = evaluation.graph_against_poses.has_value();
  add(adjusted ? "loops, adjusted" : "loops", evaluation.closed_against_poses);
  return table;
}

void add_global(HtmlPage& page, const GlobalReport& global) {
  page.heading("Global bundle adjustment");
  if (!global.adjusted) {
    page.paragraph("It was asked for and has changed nothing: " + global.reason + ".");
    return;
  }
  page.paragraph("After the loops, all keyframes and " + std::to_string(global.patches) +
                 " patches that they saw were adjusted together; the trajectory after loops is the "
                 "one after this.");
  const HtmlPage::Rows rows = {
      {"reprojection, RMS before [px]", significant_text(global.rms_before_px, 3)},
      {"reprojection, RMS after [px]", significant_text(global.rms_after_px, 3)},
      {"iterations", std::to_string(global.iterations)},
      {"observations", std::to_string(global.observations)},
      {"rejected by the solution", std::to_string(global.rejected)},
      {"left out, affinity inconsistent", std::to_string(global.inconsistent)},
      {"loops that entered as images", std::to_string(global.loops)}};
  page.table("of the adjustment", rows);
}

void add_loops(HtmlPage& page, const DriveRecord& record, const RunEvaluation& evaluation,
               const ClosedDrive& closed) {
  page.heading("Loops");
  const std::size_t count = closed.graph.loops.size();
  if (!closed.alone) {
    page.paragraph("Closed together with other logs, whose report is in the folder above: " +
                   std::to_string(closed.loops_to_others) +
                   " loops lead there. Positions after are in the " + "frame of log " +
                   std::to_string(closed.frame_of + 1) + ".");
  }
  if (!closed.note.empty()) page.warning(closed.note);
  if (count == 0 && closed.loops_to_others > 0) {
    page.figures({plot_svg(plan_of_loops(record, evaluation, closed))});
    return;
  }
  page.paragraph(
      count == 0 ? "No place of this drive was seen again so that its images prove it; the closed "
                   "trajectory is that of the odometry."
                 : std::to_string(count) +
                       " pairs of keyframes show one place (loops.csv); the drive before and after "
                       "it was closed by them (trajectory_optimised_camera.tum). A line per loop "
                       "joins its keyframes where they were before.");
  if (count > 0) page.figures({plot_svg(plan_of_loops(record, evaluation, closed))});
  const Table errors = ape_of_loops(evaluation);
  if (count > 0 && !errors.rows.empty()) page.table(errors);
  if (closed.global) add_global(page, *closed.global);
}

void add_pictures(HtmlPage& page, const DriveRecord& record, const RunEvaluation& evaluation,
                  const RunOptions& options) {
  const std::vector<WorstFrame> frames = worst_frames(record, evaluation, kPictures);
  const std::vector<FramePicture> pictures = draw_frames(record, options, frames);
  if (pictures.empty()) return;
  const bool bad = pictures.front().frame.bad;
  page.heading(bad ? "Worst frames" : "A frame");
  if (!bad) page.paragraph("No step of the drive was bad; this one had the fewest inliers.");
  page.paragraph(
      "Blue: correspondences that obey the pose of the step; orange: the others. A line runs from "
      "where a point was to where it is, its frame is what the affinity makes of a square. The "
      "pairs are extracted once more, without what a tracker remembered in the drive.");
  for (const FramePicture& picture : pictures) {
    const StepResult step = *record.frames[picture.frame.frame].step;
    page.picture("images " + std::to_string(step.index1) + " and " + std::to_string(step.index2) +
                     ": " + picture.frame.reason,
                 overlay_svg(picture.picture));
  }
}

/// The drive's last image, darkened where the car is. Empty when it cannot be read again.
std::optional<Overlay> car_picture(const DriveRecord& record, const RunOptions& options) {
  std::optional<GreyImage> image = read_image(options, record.frames.back().index);
  if (!image || image->width() != record.car_mask.width() ||
      image->height() != record.car_mask.height()) {
    return std::nullopt;
  }
  constexpr int kDarker = 3;
  for (int v = 0; v < image->height(); ++v) {
    const std::uint8_t* mask = record.car_mask.row(v);
    std::uint8_t* row = image->row(v);
    for (int u = 0; u < image->width(); ++u) {
      if (mask[u] == 0) row[u] = static_cast<std::uint8_t>(row[u] / kDarker);
    }
  }
  return Overlay{image->width(), image->height(), jpeg_of(image->view()), {}};
}

void add_car(HtmlPage& page, const DriveRecord& record, const RunOptions& options) {
  if (record.car_mask.empty()) return;
  page.heading("What belongs to the car");
  page.paragraph(
      "Dark: what rested in the image below the horizon while the car travelled, and what its lens "
      "leaves black (mask.png). It was "
      "learned over the drive and is not used from then on; front_end.features.mask.learn: false "
      "turns this off.");
  const auto picture = car_picture(record, options);
  if (picture) page.picture("the last image", overlay_svg(*picture));
}

}  // namespace

std::string report_html(const DriveRecord& record, const RunEvaluation& evaluation,
                        const RunOptions& options, const std::string& summary_text,
                        const ClosedDrive* closed) {
  const Json summary = Json::parse(summary_text);
  HtmlPage page("oneac run", options.log + " · oneac " + version());
  add_warnings(page, record);
  page.tiles(tiles_of(record, evaluation, summary));
  add_curves(page, record, evaluation);
  if (closed != nullptr) add_loops(page, record, evaluation, *closed);
  add_pictures(page, record, evaluation, options);
  add_car(page, record, options);
  page.heading("Summary");
  add_tables(page, summary);
  page.heading(kTimingHeading);
  page.figures({plot_svg(timing_plot_of(record))});
  page.begin_group();
  add_table(page, "of the stages, and of the whole", summary["timing"]);
  page.end_group();
  return page.text();
}

}  // namespace oneac::app
