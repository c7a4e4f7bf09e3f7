#include "run_outputs.h"

#include "gyroscope_check.h"
#include "odometry_edges.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/error.h"
#include "oneac/base/number_text.h"
#include "oneac/base/version.h"
#include "oneac/frontend/map_formats.h"
#include "oneac/geometry/angles.h"
#include "oneac/rawlog/calibration_writer.h"
#include "oneac/report/overlay.h"
#include "oneac/report/table.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

namespace oneac::app {

namespace {

constexpr int kTimeDecimals = 6, kAngleDecimals = 4, kSpanDecimals = 1;

/// An angle that rounds to zero keeps its sign, as this file always did.
std::string angle_text(double angle) {
  const std::string text = fixed_text(angle / kDegree, kAngleDecimals);
  return std::signbit(angle) && text.front() != '-' ? "-" + text : text;
}

void write_tilts(const DriveRecord& record, std::ostream& out) {
  out << "index,time,pitch_up_deg,pitch_sigma_deg,roll_right_deg,roll_sigma_deg,"
         "suspension_pitch_deg,suspension_sigma_deg\n";
  for (const FrameResult& frame : record.frames) {
    std::vector<std::string> cells = {std::to_string(frame.index),
                                      fixed_text(frame.time_s, kTimeDecimals)};
    const TiltBelief& tilt = frame.tilt;
    for (const double angle : {tilt.tilt.pitch_up, tilt.pitch_sigma, tilt.tilt.roll_right,
                               tilt.roll_sigma, frame.suspension.angle, frame.suspension.sigma}) {
      cells.push_back(angle_text(angle));
    }
    out << csv_line(cells);
  }
}

void write_points(const KeyframeStore& keyframes, std::ostream& out) {
  write_ply_header(keyframes.count_points(), out);
  for (std::size_t i = 0; i < keyframes.size(); ++i) write_ply_points(keyframes.points(i), out);
}

void write_simple_map(const DriveRecord& record, std::ostream& out) {
  SimpleMapWriter map(record.mount(), record.camera, record.keyframes.size(), out);
  for (std::size_t i = 0; i < record.keyframes.size(); ++i) map.add(record.keyframes[i]);
  map.finish();
}

void write_map(const DriveRecord& record, const std::filesystem::path& folder) {
  const auto write = [&](const char* name, const std::function<void(std::ostream&)>& produce) {
    write_file_atomically(folder / name, produce);
  };
  write("keyframes.tum", [&](std::ostream& out) { write_keyframes(record.keyframes, out); });
  write("graph.g2o", [&](std::ostream& out) { write_graph(record, out); });
  write("points.ply", [&](std::ostream& out) { write_points(record.keyframes, out); });
  write("map.simplemap", [&](std::ostream& out) { write_simple_map(record, out); });
}

void write_trajectories(const DriveRecord& record, const std::filesystem::path& folder) {
  const auto write = [&](const char* name, auto&& line) {
    write_file_atomically(folder / name, [&](std::ostream& out) {
      for (const FrameResult& frame : record.frames) out << line(frame);
    });
  };
  write("trajectory_camera.kitti",
        [](const FrameResult& frame) { return kitti_line(frame.T_first_cam); });
  write("trajectory_camera.tum",
        [](const FrameResult& frame) { return tum_line(frame.time_s, frame.T_first_cam); });
  write("trajectory_vehicle.tum", [&](const FrameResult& frame) {
    return tum_line(frame.time_s, record.vehicle_pose(frame.T_first_cam));
  });
}

std::string text_of(const TimeSpan& span) {
  return fixed_text(span.begin_s, kSpanDecimals) + " to " + fixed_text(span.end_s, kSpanDecimals);
}

/// Empty when a sensor says something about the time of the images.
/// @param name  "the GPS"
/// @param does  not overlap: "does" or "do"
std::string beside_images(const std::string& name, const std::string& does, const TimeSpan& sensor,
                          const DriveRecord& record) {
  if (record.frames.empty()) return "";
  const TimeSpan images{record.frames.front().time_s, record.frames.back().time_s};
  if (sensor.begin_s <= images.end_s && images.begin_s <= sensor.end_s) return "";
  return name + " (" + text_of(sensor) + " s) " + does + " not overlap the images (" +
         text_of(images) + " s) in time";
}

/// Empty without GPS and when it says something about the time of the images.
std::string gps_beside_images(const DriveRecord& record) {
  return record.gps ? beside_images("the GPS", "does", *record.gps, record) : "";
}

std::string why_wheels_tell_nothing(const DriveRecord& record) {
  if (record.source.wheel_readings == 0) return "the log holds no odometry of wheels";
  const auto& told = record.wheels;
  if (told.empty() && !record.frames.empty()) {
    return "the wheels told no speed before the last image (" +
           fixed_text(record.frames.back().time_s, kSpanDecimals) + " s)";
  }
  if (told.empty()) return "there is no image";
  std::string beside =
      beside_images("the wheels", "do", {told.front().time_s, told.back().time_s}, record);
  if (!beside.empty()) return beside;
  return "the wheels told no speeds above walking pace that agree with the images for twenty "
         "metres";
}

/// Why a drive has no metres.
std::string about_missing_scale(const DriveRecord& record) {
  constexpr const char* kSo = ", so nothing is in metres";
  if (record.scale_source == "gps") {
    return !record.gps
               ? std::string("the log holds no GPS") + kSo
               : std::string("the GPS told no speed above walking pace that covers the images") +
                     kSo;
  }
  if (record.scale_source == "wheels") {
    return why_wheels_tell_nothing(record) + kSo;
  }
  if (record.scale_source == "stereo") {
    return std::string("the right images gave too few depths") + kSo;
  }
  if (record.camera_height > 0.0) {
    return std::string("the road was nowhere seen well enough to measure by") + kSo;
  }
  return std::string("neither the height of the camera nor a speed is known") + kSo +
         "; give --camera-height, or set front_end.scale.source: gps" +
         (record.source.wheel_readings > 0 ? " or wheels" : "");
}

/// Who could have told a length in metres.
std::string tellers(const DriveRecord& record) {
  if (record.scale_source == "gps") return "landmarks nor GPS speeds";
  if (record.scale_source == "wheels") return "landmarks nor wheels";
  return record.scale_source == "stereo" ? "landmarks nor right images" : "landmarks nor the road";
}

/// Where a drive in metres has none; empty when it has them everywhere.
std::string about_steps_without_metres(const DriveRecord& record) {
  std::size_t steps = 0, before = 0, later = 0;
  bool known = false;
  for (const FrameResult& frame : record.frames) {
    if (!frame.step) continue;
    ++steps;
    known = known || frame.step->metric;
    if (!frame.step->metric) ++(known ? later : before);
  }
  if (before + later == 0) return "";
  std::string text = std::to_string(before + later) + " of " + std::to_string(steps) +
                     " steps are not in metres: ";
  if (before > 0) text += std::to_string(before) + " before the first that was measured";
  if (before > 0 && later > 0) text += ", ";
  if (later > 0) {
    text += std::to_string(later) + " of which neither " + tellers(record) +
            " told the length well enough";
  }
  return text;
}

/// Empty when every answer of the initialiser could be used.
std::string about_faulty_answers(const DriveRecord& record) {
  if (record.faulty.count == 0) return "";
  return std::to_string(record.faulty.count) +
         " answers of the initialiser cannot be used (first: " + record.faulty.first + ")";
}

/// Images that have no right one, where the scale comes of stereo.
std::string about_lone_images(const DriveRecord& record) {
  const SourceReport& source = record.source;
  if (record.scale_source != "stereo" || source.first_lone.empty()) return "";
  const std::size_t frames = record.frames.size();
  const std::size_t lone = frames - std::min(frames, source.pairs_delivered);
  return std::to_string(lone) + " of " + std::to_string(frames) +
         " images have no right image (first: " + source.first_lone +
         "); their lengths come of the motion before and after";
}

/// Sensors whose turns are not those of the images.
std::string about_contradicting_turns(const DriveRecord& record) {
  std::string sensors;
  for (const std::string& sensor : record.camera_belief.contradicting) {
    sensors += (sensors.empty() ? "" : " and ") + sensor;
  }
  if (sensors.empty()) return "";
  return "turns by " + sensors +
         " contradict those of the images: not used for the focal length, "
         "which is less sure for it; check unit, axis, sign and clock of the sensor";
}

/// A camera that is in doubt without being refused.
std::string about_doubted_lengths(const DriveRecord& record) {
  constexpr double kWorthSaying = 0.015;  // [-] what the height alone leaves open
  if (!record.setup_faults.empty() || record.length_doubt < kWorthSaying) return "";
  const CameraBelief& belief = record.camera_belief;
  return "bends say a focal length of " + fixed_text(belief.focal_px, 0) + " px (to " +
         fixed_text(100.0 * belief.focal_sigma, 1) + " %) where the calibration has " +
         fixed_text(belief.given.focal_px(), 0) + " px: lengths are " +
         fixed_text(100.0 * record.length_doubt, 1) +
         " % less sure for it; \"oneac calibrate LOG -o camera.ini\" tells more";
}

std::string about_used_camera(const DriveRecord& record) {
  const CameraBelief& belief = record.camera_belief;
  if (belief.used.fx == belief.given.fx) return "as given: the drive does not say otherwise";
  const bool all = belief.raw_used.cx != record.raw_camera.cx;
  return std::string(all ? "focal length, principal point, k1 and k2" : "focal length") +
         " learned by " + std::to_string(belief.bends) + " bends, the focal length good to " +
         fixed_text(100.0 * belief.focal_sigma, 1) + " % (1 sigma), the rest as given";
}

}  // namespace

std::string used_camera_ini(const DriveRecord& record, const std::string& log) {
  const CameraBelief& belief = record.camera_belief;
  if (!belief.knows_raw) return "";
  return calibration_text(belief.raw_used,
                          {"used by oneac run (oneac " + version() + ") at the end of " + log,
                           about_used_camera(record)});
}

void write_drive(const DriveRecord& record, const std::filesystem::path& folder) {
  write_trajectories(record, folder);
  const auto write = [&](const char* name, const std::string& header, auto each, auto* line) {
    write_file_atomically(folder / name, [&](std::ostream& out) {
      out << header;
      (record.*each)([&](const auto& row) { out << line(row); });
    });
  };
  write("relative_poses.csv", relative_poses_header(), &DriveRecord::each_relative_pose,
        relative_pose_line);
  write("covariance.csv", covariances_header(), &DriveRecord::each_covariance, covariance_line);
  write("trajectory_camera.csv", pose_covariances_header(), &DriveRecord::each_camera_pose,
        pose_covariance_line);
  write("trajectory_vehicle.csv", pose_covariances_header(), &DriveRecord::each_vehicle_pose,
        pose_covariance_line);
  write_file_atomically(folder / "tilt.csv", [&](std::ostream& out) { write_tilts(record, out); });
  if (!record.keyframes.empty()) write_map(record, folder);
  if (!record.car_mask.empty()) {
    write_file_atomically(folder / "mask.png", png_of(record.car_mask.view()));
  }
  write("timings.csv", timings_header(), &DriveRecord::each_timing, timing_line);
}

void fail_if_empty(const DriveRecord& record, const std::string& log) {
  if (!record.frames.empty()) return;
  fail_if_incomplete(record);
  throw InputError(log,
                   "none of the " + std::to_string(record.source.images_in_log) +
                       " images of this camera is selected and there",
                   "correct --first and --count");
}

void fail_if_incomplete(const DriveRecord& record) {
  if (!record.failure.empty()) throw InputError("stopped early", record.failure, "");
  if (!record.source.damage.empty()) throw InputError("log", record.source.damage, "");
  if (record.interrupted) throw std::runtime_error("interrupted; what was computed is written");
}

std::string about_strange_gyroscope(const DriveRecord& record) {
  const std::vector<ImuSample>& imu = record.source.reference.imu;
  // Nor are the images to be believed where camera or mount are wrong.
  if (imu.empty() || !record.setup_faults.empty()) return "";
  std::vector<bool> carried;
  for (const FrameResult& frame : record.frames) {
    carried.push_back(frame.step && frame.step->status != StepStatus::kPredicted);
  }
  const auto fault = fault_of_gyroscope(record.vehicle_trajectory(), carried, imu);
  return fault ? about_gyroscope(*fault) : "";
}

namespace {

/// Masks that leave little of the images; most often they are white where they should be black.
std::string about_masks(const DriveRecord& record) {
  constexpr double kWorthSaying = 0.5;
  if (record.frames.empty()) return "";
  const double share = record.masked / static_cast<double>(record.frames.size());
  if (share <= kWorthSaying) return "";
  return "the masks leave out " + fixed_text(100.0 * share, 0) +
         " % of the images: what is dark in a mask is not used; turn masks about that are white "
         "there";
}

/// What became of the images themselves.
std::vector<std::string> notes_about_images(const DriveRecord& record) {
  std::vector<std::string> notes;
  const SourceReport& source = record.source;
  if (source.images_missing > 0) {
    notes.push_back(std::to_string(source.images_missing) + " of " +
                    std::to_string(source.images_in_log) +
                    " images of this camera are not on disk (first: " + source.first_missing +
                    "); using those that are");
  }
  if (record.out_of_order > 0) {
    notes.push_back(std::to_string(record.out_of_order) +
                    " images do not lie after the one before in time and were left out");
  }
  if (record.repeated > 0) {
    notes.push_back(
        std::to_string(record.repeated) + " images repeat the one before, pixel by pixel (first: " +
        record.first_repeated + "), and were left out: the camera froze, or a video was stretched");
  }
  if (const std::string lone = about_lone_images(record); !lone.empty()) notes.push_back(lone);
  if (const std::string masks = about_masks(record); !masks.empty()) notes.push_back(masks);
  return notes;
}

}  // namespace

std::vector<std::string> notes_about(const DriveRecord& record) {
  std::vector<std::string> notes = notes_about_images(record);
  if (!record.tilt_fallback.empty()) notes.push_back(record.tilt_fallback);
  if (const std::string gps = gps_beside_images(record); !gps.empty()) notes.push_back(gps);
  if (!record.source.calibration_scaled.empty()) {
    notes.push_back(record.source.calibration_scaled);
  }
  notes.insert(notes.end(), record.setup_faults.begin(), record.setup_faults.end());
  if (record.car_mask_refused) {
    notes.push_back(
        "nearly half of the image rests while the car travels, more than its own parts can be, so "
        "none of it was masked; mask what is the car's: front_end.features.mask.polygon");
  }
  if (const std::string doubt = about_doubted_lengths(record); !doubt.empty()) {
    notes.push_back(doubt);
  }
  if (const std::string turns = about_contradicting_turns(record); !turns.empty()) {
    notes.push_back(turns);
  }
  if (const std::string strange = about_strange_gyroscope(record); !strange.empty()) {
    notes.push_back(strange);
  }
  if (record.stamps_are_wrong && record.setup_faults.empty()) {
    notes.push_back(
        "stamps are not those of the images: lengths that landmarks and road agree on would need "
        "accelerations that no car has; were images dropped under a fixed rate? Speeds are wrong");
  }
  const bool told = !record.setup_faults.empty();
  if (!told && !record.has_scale() && record.frames.size() > 1) {
    notes.push_back(about_missing_scale(record));
  }
  if (!told && record.has_scale()) {
    if (std::string text = about_steps_without_metres(record); !text.empty()) {
      notes.push_back(std::move(text));
    }
  }
  if (const std::string faulty = about_faulty_answers(record); !faulty.empty()) {
    notes.push_back(faulty);
  }
  const std::size_t predicted = count_status(record, StepStatus::kPredicted);
  if (predicted > 0) {
    notes.push_back(std::to_string(predicted) +
                    " steps were not carried by their images and repeat the motion before");
  }
  const std::size_t repeated =
      count_steps(record, [](const StepResult& s) { return s.repeats_image; });
  if (repeated > 0) {
    notes.push_back(std::to_string(repeated) +
                    " images show once more what had moved until then, all of it at rest: a video "
                    "at another rate than its camera's? Their steps are zero and not metric, and "
                    "speeds are as wrong as the stamps");
  }
  return notes;
}

}  // namespace oneac::app
