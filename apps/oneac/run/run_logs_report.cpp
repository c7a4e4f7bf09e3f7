#include "run_logs_report.h"

#include "run_summary.h"

#include "oneac/base/number_text.h"
#include "oneac/base/version.h"
#include "oneac/evaluation/trajectory_io.h"
#include "oneac/report/html_page.h"
#include "oneac/report/plot.h"
#include "oneac/report/table.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace oneac::app {
namespace {

using Json = nlohmann::ordered_json;

std::size_t loops_between_logs(const ClosedDrives& closed) {
  return static_cast<std::size_t>(
      std::count_if(closed.graph.loops.begin(), closed.graph.loops.end(), [&](const auto& loop) {
        return closed.keyframes[loop.first].log != closed.keyframes[loop.second].log;
      }));
}

std::size_t logs_in_first_frame(const ClosedDrives& closed) {
  return static_cast<std::size_t>(std::count_if(closed.drives.begin(), closed.drives.end(),
                                                [](const auto& d) { return d.frame_of == 0; }));
}

/// Seen from above in the first log's frame: right of its first heading, ahead of it.
std::pair<double, double> from_above(const DriveRecord& first, const Eigen::Isometry3d& T) {
  const Eigen::Vector3d p = first.mount().linear() * T.translation();
  return {-p.y(), p.x()};
}

Plot plan_of_logs(const std::vector<RecordedDrive>& drives, const ClosedDrives& closed) {
  Plot plan{"Joined logs, first heading up", "m", "", {}, false, Axes::kPlan};
  const DriveRecord& first = *drives.front().record;
  const auto append = [&](PlotSeries& series, const Eigen::Isometry3d& T) {
    const auto [right, ahead] = from_above(first, T);
    series.x.push_back(right);
    series.y.push_back(ahead);
  };
  for (const ClosedDrive& drive : closed.drives) {
    if (drive.frame_of != 0) continue;
    PlotSeries way{"log " + std::to_string(drive.log + 1), {}, {}, Pen::kLine};
    for (const Eigen::Isometry3d& T : drive.frames) append(way, T);
    plan.series.push_back(std::move(way));
  }
  PlotSeries loops{"loops between logs", {}, {}, Pen::kLine};
  for (const LoopConstraint& loop : closed.graph.loops) {
    const std::size_t a = closed.keyframes[loop.first].log, b = closed.keyframes[loop.second].log;
    if (a == b || closed.drives[a].frame_of != 0) continue;
    append(loops, closed.graph.T_first_cam[loop.first]);
    append(loops, closed.graph.T_first_cam[loop.second]);
    loops.x.push_back(std::numeric_limits<double>::quiet_NaN());
    loops.y.push_back(std::numeric_limits<double>::quiet_NaN());
  }
  if (!loops.x.empty()) plan.series.push_back(std::move(loops));
  return plan;
}

Table table_of(const std::vector<RecordedDrive>& drives, const ClosedDrives& closed) {
  Table table{
      "Each log has its own report in its folder",
      {"log", "folder", "frame of log", "frames", "keyframes", "way", "loops", "loops to others"},
      {},
      2};
  for (const ClosedDrive& drive : closed.drives) {
    const DriveRecord& record = *drives[drive.log].record;
    const std::string unit = record.has_scale() ? " m" : " units";
    table.rows.push_back({{drives[drive.log].options->log},
                          {drives[drive.log].options->output},
                          {std::to_string(drive.frame_of + 1)},
                          {std::to_string(record.frames.size())},
                          {std::to_string(drive.keyframes.size())},
                          {fixed_text(way_along(record.frames), 1) + unit},
                          {std::to_string(drive.graph.loops.size())},
                          {std::to_string(drive.loops_to_others)}});
  }
  return table;
}

/// Why a log has a frame of its own.
std::string why_apart(const ClosedDrive& drive, const ClosedDrives& closed) {
  if (!closed.searched) return "the search was not finished";
  const bool metric = std::any_of(drive.keyframes.begin(), drive.keyframes.end(),
                                  [](const LoopKeyframe& k) { return k.metric; });
  if (!metric) return "it has no keyframe in metres";
  std::string why = "no stretch proves beyond doubt that both saw one place";
  if (const std::size_t apart = closed.report.apart_by_gps; apart > 0) {
    why += " (GPS has " + std::to_string(apart) + " pairs that look alike far from each other)";
  }
  return why;
}

}  // namespace

std::vector<std::string> about_logs_apart(const std::vector<RecordedDrive>& drives,
                                          const ClosedDrives& closed) {
  std::vector<std::string> lines;
  for (const ClosedDrive& drive : closed.drives) {
    if (drive.frame_of == 0) continue;
    std::string line = drives[drive.log].options->log + " is not joined to " +
                       drives.front().options->log + ": " + why_apart(drive, closed) +
                       "; its poses are in ";
    line += drive.frame_of == drive.log ? std::string("its own frame")
                                        : "the frame of " + drives[drive.frame_of].options->log;
    lines.push_back(std::move(line));
  }
  return lines;
}

std::string logs_summary_json(const std::vector<RecordedDrive>& drives, const ClosedDrives& closed,
                              double wall_seconds) {
  Json logs = Json::array();
  for (const ClosedDrive& drive : closed.drives) {
    const DriveRecord& record = *drives[drive.log].record;
    logs.push_back({{"log", drives[drive.log].options->log},
                    {"folder", std::to_string(drive.log + 1)},
                    {"frame_of_log", drive.frame_of + 1},
                    {"joined_to_first", drive.frame_of == 0},
                    {"metric", record.has_scale()},
                    {"frames", record.frames.size()},
                    {"keyframes", drive.keyframes.size()},
                    {"loops", drive.graph.loops.size()},
                    {"loops_to_other_logs", drive.loops_to_others}});
  }
  const LoopReport& report = closed.report;
  Json json = {{"version", version()},
               {"logs", logs},
               {"loops",
                {{"loops", closed.graph.loops.size()},
                 {"between_logs", loops_between_logs(closed)},
                 {"keyframes", report.keyframes},
                 {"keyframes_not_metric", report.not_metric},
                 {"pairs_alike", report.candidates},
                 {"pairs_verified", report.verified},
                 {"apart_by_gps", report.apart_by_gps},
                 {"refused_by_odometry", report.impossible},
                 {"refused_by_other_loops", report.contradicted}}}};
  if (closed.global) json["loops"]["global_ba"] = global_json(*closed.global);
  json["timing"] = {{"wall_s", wall_seconds}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string logs_report_html(const std::vector<RecordedDrive>& drives, const ClosedDrives& closed) {
  HtmlPage page("oneac run", std::to_string(drives.size()) + " logs · oneac " + version());
  if (!closed.note.empty()) page.warning(closed.note);
  for (const std::string& line : about_logs_apart(drives, closed)) page.warning(line);
  page.tiles({{"logs in the frame of the first", std::to_string(logs_in_first_frame(closed)) +
                                                     " of " + std::to_string(drives.size())},
              {"loops between logs", std::to_string(loops_between_logs(closed))},
              {"loops in all", std::to_string(closed.graph.loops.size())}});
  page.heading("The logs together");
  page.figures({plot_svg(plan_of_logs(drives, closed))});
  page.table(table_of(drives, closed));
  return page.text();
}

std::string text_about_logs(const std::vector<RecordedDrive>& drives, const ClosedDrives& closed) {
  return "together: " + std::to_string(loops_between_logs(closed)) + " loops between logs, " +
         std::to_string(logs_in_first_frame(closed)) + " of " + std::to_string(drives.size()) +
         " logs in the frame of " + drives.front().options->log +
         (closed.global ? "; " + text_about(*closed.global) : "") + '\n';
}

}  // namespace oneac::app
