#include "run_summary.h"

#include "gps_lag.h"
#include "run_georeference.h"

#include "oneac/base/error.h"
#include "oneac/base/number_text.h"
#include "oneac/base/printable.h"
#include "oneac/base/version.h"
#include "oneac/calibration/intrinsics_belief.h"
#include "oneac/evaluation/report.h"
#include "oneac/geometry/angles.h"
#include "oneac/rawlog/log_neighbours.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <thread>
#include <vector>

namespace oneac::app {
namespace {

using Json = nlohmann::ordered_json;

/// What was asked for, else what lies beside the log: if that cannot be read, nobody asked for it.
std::optional<Trajectory> reference_of(const RunOptions& options, RunEvaluation& evaluation) {
  const std::string& asked = options.run.reference;
  const std::string file = asked.empty() ? poses_beside(options.log) : asked;
  if (file.empty()) return std::nullopt;
  try {
    Trajectory reference = read_trajectory(file);
    evaluation.reference_file = file;
    return reference;
  } catch (const InputError& error) {
    if (!asked.empty()) throw;
    evaluation.reference_fault = error.what();
    return std::nullopt;
  }
}

/// Frames [first, last] whose times the GPS covers, so that nothing is extrapolated.
struct FrameRange {
  std::size_t first = 0;
  std::size_t last = 0;
};

std::optional<FrameRange> frames_under_gps(const DriveRecord& record) {
  const std::vector<GpsFix>& gps = record.source.reference.gps;
  if (gps.empty()) return std::nullopt;
  std::optional<FrameRange> range;
  std::size_t i = 0;
  for (const FrameResult& frame : record.frames) {
    const bool covered = frame.time_s >= gps.front().time_s && frame.time_s <= gps.back().time_s;
    if (covered && !range) range = FrameRange{i, i};
    if (covered) range->last = i;
    ++i;
  }
  if (!range || range->first == range->last) return std::nullopt;
  return range;
}

/// Yaw of the vehicle over the range, turn by turn [rad].
double heading_change(const Trajectory& vehicle, const FrameRange& range) {
  double sum = 0.0;
  for (std::size_t i = range.first + 1; i <= range.last; ++i) {
    const Eigen::Matrix3d R = vehicle.poses[i - 1].linear().transpose() * vehicle.poses[i].linear();
    sum += std::atan2(R(1, 0), R(0, 0));
  }
  return sum;
}

std::optional<GpsComparison> compare_with_gps(const DriveRecord& record) {
  const auto range = frames_under_gps(record);
  if (!range) return std::nullopt;
  const double t0 = record.frames[range->first].time_s;
  const double t1 = record.frames[range->last].time_s;
  GpsComparison comparison;
  comparison.heading_change = record.source.reference.heading_change(t0, t1);
  comparison.distance = record.source.reference.distance(t0, t1);
  if (!comparison.heading_change && !comparison.distance) return std::nullopt;
  comparison.estimated_heading_change = heading_change(record.vehicle_trajectory(), *range);
  const std::vector<Eigen::Isometry3d> poses = record.camera_trajectory().poses;
  comparison.estimated_distance =
      path_length({poses.begin() + static_cast<std::ptrdiff_t>(range->first),
                   poses.begin() + static_cast<std::ptrdiff_t>(range->last) + 1});
  return comparison;
}

/// "all" steps are in metres, "partly" (the others hold the speed), or "none".
std::string metric_word(const DriveRecord& record) {
  const std::size_t metric = count_steps(record, [](const StepResult& s) { return s.metric; });
  const std::size_t steps = record.frames.empty() ? 0 : record.frames.size() - 1;
  if (!record.has_scale()) return "none";
  return metric == steps ? "all" : "partly";
}

/// Pieces of the drive between which tracking had to start anew; 1 when it never did.
std::size_t segments(const DriveRecord& record) {
  std::size_t last = 0;
  for (const FrameResult& frame : record.frames) {
    if (frame.step) last = std::max(last, frame.step->segment);
  }
  return last + 1;
}

Json counts_json(const DriveRecord& record) {
  return {{"images_in_log", record.source.images_in_log},
          {"images_missing", record.source.images_missing},
          {"images_out_of_order", record.out_of_order},
          {"images_repeated", record.repeated},
          {"frames", record.frames.size()},
          {"steps_ok", count_status(record, StepStatus::kOk)},
          {"steps_no_motion", count_status(record, StepStatus::kNoMotion)},
          {"steps_predicted", count_status(record, StepStatus::kPredicted)},
          {"steps_of_repeated_images",
           count_steps(record, [](const StepResult& s) { return s.repeats_image; })},
          {"keyframes", record.keyframes.size()},
          {"segments", segments(record)},
          {"steps_metric", count_steps(record, [](const StepResult& s) { return s.metric; })}};
}

Json tilt_json(const Tilt& tilt) {
  return {{"pitch_up_deg", tilt.pitch_up / kDegree}, {"roll_right_deg", tilt.roll_right / kDegree}};
}

/// What the springs did in frames that the images told about.
Json suspension_json(const DriveRecord& record) {
  std::vector<double> pitch_deg, sigma_deg;
  for (const FrameResult& frame : record.frames) {
    if (!frame.step || frame.step->status == StepStatus::kPredicted) continue;
    pitch_deg.push_back(std::abs(frame.suspension.angle) / kDegree);
    sigma_deg.push_back(frame.suspension.sigma / kDegree);
  }
  if (pitch_deg.empty()) return nullptr;
  const Statistics pitch = *statistics_of(pitch_deg);
  return {{"used_for", "initialiser and road"},
          {"rms_deg", pitch.rmse},
          {"largest_deg", pitch.max},
          {"sigma_median_deg", statistics_of(sigma_deg)->median}};
}

/// What bends say of the focal length; null where the drive cannot know.
Json learned_json(const DriveRecord& record) {
  const CameraBelief& belief = record.camera_belief;
  const bool learned = belief.used.fx != belief.given.fx;
  Json json = {{"used", learned ? "learned" : "given"},
               {"focal_used_last_px", belief.used.focal_px()},
               {"bends", belief.bends},
               {"sensors", belief.sensors},
               {"sensors_contradicting", belief.contradicting},
               {"focal_by_bends_px", nullptr},
               {"focal_sigma", belief.focal_sigma}};
  if (belief.knows_focal()) json["focal_by_bends_px"] = belief.focal_px;
  if (!belief.knows_raw || belief.bends < IntrinsicsBelief::kFewestWindows) return json;
  const PinholeCamera& c = belief.raw_learned;
  const double px = record.raw_camera.focal_px();
  json["raw_camera_by_bends"] = {{"fx_px", c.fx},
                                 {"fy_px", c.fy},
                                 {"cx_px", c.cx},
                                 {"cy_px", c.cy},
                                 {"k1", c.distortion[0]},
                                 {"k2", c.distortion[1]},
                                 {"cx_sigma_px", px * belief.sigma[kCentreX]},
                                 {"cy_sigma_px", px * belief.sigma[kCentreY]},
                                 {"k1_sigma", belief.sigma[kK1]},
                                 {"k2_sigma", belief.sigma[kK2]}};
  return json;
}

Json camera_json(const DriveRecord& record) {
  const PinholeCamera& c = record.camera;
  return {
      {"width_px", c.width},
      {"height_px", c.height},
      {"fx_px", c.fx},
      {"fy_px", c.fy},
      {"cx_px", c.cx},
      {"cy_px", c.cy},
      {"self_calibration", learned_json(record)},
      {"tilt_given", tilt_json(record.given_tilt)},
      {"tilt_used_last", tilt_json(record.tilt)},
      {"tilt_sigma", tilt_json({record.tilt_belief.pitch_sigma, record.tilt_belief.roll_sigma})},
      {"suspension_pitch", suspension_json(record)}};
}

Json gps_json(const GpsComparison& gps) {
  Json json;
  json["estimated_heading_change_deg"] = gps.estimated_heading_change / kDegree;
  if (gps.heading_change) json["gps_heading_change_deg"] = *gps.heading_change / kDegree;
  json["estimated_distance"] = gps.estimated_distance;
  if (gps.distance) json["gps_distance_m"] = *gps.distance;
  return json;
}

Json stage_json(const std::vector<double>& ms) {
  if (ms.empty()) return nullptr;
  const Statistics s = *statistics_of(ms);
  return {{"median_ms", s.median}, {"mean_ms", s.mean}, {"p95_ms", s.p95}};
}

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.rfind("model name", 0) != 0) continue;
    const auto colon = line.find(": ");
    if (colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

Json timing_json(const DriveRecord& record, const RunOptions& options, double wall_seconds) {
  std::vector<double> decode, features, estimate, refine;
  record.each_timing([&](const TimingRow& row) {
    decode.push_back(row.decode_ms);
    features.push_back(row.features_ms);
    estimate.push_back(row.estimate_ms);
    refine.push_back(row.refine_ms);
  });
  const double frames = static_cast<double>(record.frames.size());
  return {{"wall_s", wall_seconds},
          {"frames_per_s", wall_seconds > 0.0 ? frames / wall_seconds : 0.0},
          {"threads", options.run.threads},
          {"processor", processor_name()},
          {"cores", std::thread::hardware_concurrency()},
          {"decode", stage_json(decode)},
          {"features", stage_json(features)},
          {"estimate", stage_json(estimate)},
          {"refine", stage_json(refine)}};
}

Json loops_json(const ClosedDrive& closed, const RunEvaluation& evaluation) {
  const LoopReport& report = closed.report;
  Json json = {{"loops", closed.graph.loops.size()},
               {"keyframes", closed.alone ? report.keyframes : closed.keyframes.size()}};
  if (closed.alone) {
    json.update({{"keyframes_not_metric", report.not_metric},
                 {"pairs_alike", report.candidates},
                 {"pairs_verified", report.verified},
                 {"apart_by_gps", report.apart_by_gps},
                 {"refused_by_odometry", report.impossible},
                 {"refused_by_other_loops", report.contradicted}});
  } else {
    json.update({{"loops_to_other_logs", closed.loops_to_others},
                 {"log", closed.log + 1},
                 {"frame_of_log", closed.frame_of + 1}});
  }
  if (closed.global) json["global_ba"] = global_json(*closed.global);
  const auto& after = evaluation.closed_against_poses;
  if (!after || !after->trajectory || !evaluation.against_poses->trajectory) return json;
  json["ape_before_m"] = evaluation.against_poses->trajectory->ape.rmse;
  const auto& graph = evaluation.graph_against_poses;
  if (graph && graph->trajectory) json["ape_of_pose_graph_m"] = graph->trajectory->ape.rmse;
  json["ape_after_m"] = after->trajectory->ape.rmse;
  return json;
}

}  // namespace

nlohmann::ordered_json global_json(const GlobalReport& global) {
  Json json = {{"adjusted", global.adjusted}};
  if (!global.adjusted) json["reason"] = global.reason;
  json.update({{"iterations", global.iterations},
               {"patches", global.patches},
               {"patches_of_loops", global.shared},
               {"patches_passed_over", global.passed_over},
               {"observations", global.observations},
               {"observations_not_affine_consistent", global.inconsistent},
               {"observations_rejected", global.rejected},
               {"loops_as_images", global.loops},
               {"reprojection_rms_before_px", global.rms_before_px},
               {"reprojection_rms_after_px", global.rms_after_px}});
  return json;
}

RunEvaluation evaluate_record(const DriveRecord& record, const RunOptions& options,
                              const ClosedDrive* closed) {
  RunEvaluation evaluation;
  const auto found = reference_of(options, evaluation);
  if (found && record.frames.size() > 1) {
    const Trajectory& reference = *found;
    const auto against = [&](const Trajectory& camera) {
      return evaluate_run(record.relative_poses(), camera, reference,
                          metric_word(record) == "none" ? Alignment::kSim3 : Alignment::kSe3);
    };
    evaluation.against_poses = against(record.camera_trajectory());
    if (closed != nullptr) {
      Trajectory camera = closed->camera_trajectory(record);
      evaluation.closed_against_poses = against(camera);
      camera.poses = closed->frames_of_graph;
      if (!camera.poses.empty()) evaluation.graph_against_poses = against(camera);
    }
  }
  evaluation.against_gps = compare_with_gps(record);
  if (!record.source.reference.gps.empty()) {
    evaluation.gps_lag_s = lag_of_gps(record.vehicle_trajectory(), record.source.reference);
  }
  evaluation.georeference = georeference_of(record);
  return evaluation;
}

std::string summary_json(const DriveRecord& record, const RunEvaluation& evaluation,
                         const RunOptions& options, double wall_seconds,
                         const ClosedDrive* closed) {
  Json json;
  json["version"] = version();
  json["log"] = options.log;
  json["initialiser"] = options.front_end.initialiser;
  json["seed"] = options.run.seed;
  json["metric"] = metric_word(record);
  json["camera_height_m"] = record.camera_height;
  json["scale_source"] = options.front_end.scale.source;
  json["scale_uncertainty"] =
      std::isfinite(record.scale_uncertainty) ? Json(record.scale_uncertainty) : Json(nullptr);
  json["tilt_source"] = record.tilt_source;
  json["car_mask_share"] = record.car_mask_share();
  json["car_mask_refused"] = record.car_mask_refused;
  json["length_doubt"] = record.length_doubt;
  json["stamps_are_wrong"] = record.stamps_are_wrong;
  json["setup_faults"] = record.setup_faults;
  json["tilt_source_asked_for"] = options.front_end.tilt.source;
  json["counts"] = counts_json(record);
  json["camera"] = camera_json(record);
  json["path_length"] = way_along(record.frames);
  json["interrupted"] = record.interrupted;
  json["damage"] = record.source.damage;
  json["failure"] = record.failure;
  Json reference;
  if (evaluation.against_poses) {
    reference["poses"] = evaluation.reference_file;
    reference["errors"] = Json::parse(format_json(*evaluation.against_poses, false));
  }
  if (evaluation.against_gps) reference["gps"] = gps_json(*evaluation.against_gps);
  if (evaluation.gps_lag_s) reference["gps"]["lag_s"] = *evaluation.gps_lag_s;
  json["reference"] = reference;
  json["georeference"] = georeference_json(record, evaluation.georeference);
  if (closed != nullptr) json["loops"] = loops_json(*closed, evaluation);
  json["timing"] = timing_json(record, options, wall_seconds);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string summary_text(const DriveRecord& record, const RunEvaluation& evaluation) {
  const std::string metric = metric_word(record), unit = metric == "none" ? "units" : "m";
  std::string text = std::to_string(record.frames.size()) + " frames, " +
                     fixed_text(way_along(record.frames), 1) + " " + unit + ", metric: " + metric +
                     "\n";
  if (const double share = record.car_mask_share(); share > 0.0) {
    text += "learned as the car's own: " + fixed_text(100.0 * share, 1) +
            " % of the image (mask.png)\n";
  }
  if (record.source.undistorted_by_log) {
    text +=
        "images undistorted by the calibration in the log; if they are rectified, give theirs: "
        "--calibration\n";
  }
  if (evaluation.against_poses) {
    text += "against " + printable(evaluation.reference_file) + ":\n";
    text += format_table(*evaluation.against_poses, false);
  }
  if (evaluation.gps_lag_s) text += about_lag(*evaluation.gps_lag_s);
  if (evaluation.against_gps) {
    const GpsComparison& gps = *evaluation.against_gps;
    if (gps.heading_change) {
      text += "change of heading " + fixed_text(gps.estimated_heading_change / kDegree, 2) +
              " deg (GPS course " + fixed_text(*gps.heading_change / kDegree, 2) + " deg)\n";
    }
    if (gps.distance) {
      text += "path " + fixed_text(gps.estimated_distance, 2) + " " + unit +
              " (GPS speed: " + fixed_text(*gps.distance, 2) + " m)\n";
    }
  }
  return text;
}

}  // namespace oneac::app
