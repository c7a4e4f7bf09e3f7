#pragma once

#include "record_store.h"

#include "oneac/base/image.h"
#include "oneac/evaluation/covariance_io.h"
#include "oneac/evaluation/relative_poses_io.h"
#include "oneac/evaluation/trajectory_io.h"
#include "oneac/frontend/front_end.h"
#include "oneac/rawlog/rawlog_source.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace oneac::app {

/// A stretch of time.
struct TimeSpan {
  double begin_s, end_s;  ///< [s] Unix times
};

/// Answers of the initialiser that were not used, see StepResult::fault.
struct FaultyAnswers {
  std::size_t count = 0;
  std::string first;  ///< with its images
};

/// What a run has computed so far: grows frame by frame and can be written at any time. Frames and
/// keyframes leave memory as they become many, see Spool; so reading them takes a copy each.
struct DriveRecord {
  /// @param folder  where a nameless file may hold what memory should not; "": that for such files
  explicit DriveRecord(const std::filesystem::path& folder = {})
      : frames(folder), keyframes(folder) {}

  FrameStore frames;
  KeyframeStore keyframes;  ///< settled ones, in order
  FaultyAnswers faulty;
  std::vector<double> decode_ms;  ///< one per frame
  SettledTracks tracks;           ///< of the keyframes; empty unless they were asked for
  Eigen::Isometry3d T_vehicle_cam = CameraFrame::forward_looking_mount();  ///< as the log says
  PinholeCamera camera;
  std::string tilt_source;     ///< that was used: front_end.tilt.source, or what stood in for it
  std::string tilt_fallback;   ///< one line when another one stood in, else ""
  PinholeCamera raw_camera;    ///< of the images as they are stored
  CameraBelief camera_belief;  ///< what bends say of it, at the end
  Tilt given_tilt;             ///< from the log or the parameters
  TiltBelief tilt_belief;      ///< with its 1σ, at the end
  double scale_uncertainty = 0.0;    ///< relative 1σ of the map's lengths at the end
  double common_length_sigma = 0.0;  ///< relative 1σ of length that all steps share
  Tilt tilt;                         ///< as believed at the end
  double camera_height = 0.0;        ///< [m] in use; 0: none
  std::string scale_source;          ///< the parameter front_end.scale.source
  double masked = 0.0;               ///< shares of the frames that their masks leave out, summed
  GreyImage car_mask;                ///< FrontEnd::car_mask() at the end
  bool car_mask_refused = false;     ///< FrontEnd::car_mask_refused() at the end
  double length_doubt = 0.0;         ///< FrontEnd::length_doubt() at the end
  bool stamps_are_wrong = false;     ///< FrontEnd::stamps_are_wrong() at the end
  SourceReport source;
  std::vector<SpeedReading> wheels;  ///< by the odometer of the log, in time order
  std::optional<TimeSpan> gps;  ///< from the first fix to the last, of what was read of the log
  std::vector<std::string> setup_faults;  ///< of camera and log, at the end: nothing is in metres
  std::size_t out_of_order = 0;           ///< images left out: not later than the one before
  std::size_t repeated = 0;               ///< images left out: the pixels of the one before
  std::string first_repeated;             ///< name of the first of them
  bool interrupted = false;
  std::string failure;  ///< one line when an image stopped the run early, else ""

  /// Whether lengths are metres, at least from some step on.
  [[nodiscard]] bool has_scale() const;
  /// Of the image, dark in car_mask. [-]
  [[nodiscard]] double car_mask_share() const;
  /// Takes the next frame, and what it has made final.
  void add(FrameResult frame, double decode_ms);
  /// Takes over what has become final.
  void take(const Settled& settled);
  void take(const SettledTracks& settled);
  /// Every length is as unsure as the camera makes it, the steps before it was known, too.
  /// @param doubt, max_uncertainty  relative 1σ, see doubt_metres() of a step
  void doubt_metres(double doubt, double max_uncertainty);
  /// Nothing is in metres, the steps before the fault was found neither.
  void withdraw_metres();
  /// The camera on the vehicle: as the log says, with the pitch and roll of `tilt`.
  [[nodiscard]] Eigen::Isometry3d mount() const;
  /// The vehicle (X forward, Z up) against its first pose, by the camera's T_first_cam.
  [[nodiscard]] Eigen::Isometry3d vehicle_pose(const Eigen::Isometry3d& T_first_cam) const;
  /// Camera trajectory, first camera = identity.
  [[nodiscard]] Trajectory camera_trajectory() const;
  /// Vehicle trajectory (X forward, Z up), first vehicle pose = identity; the mount is the log's
  /// with the pitch and roll of `tilt`.
  [[nodiscard]] Trajectory vehicle_trajectory() const;
  [[nodiscard]] std::vector<RelativePoseRow> relative_poses() const;
  /// Rows of result files, one after the other, in order of time.
  void each_relative_pose(const std::function<void(const RelativePoseRow&)>& visit) const;
  void each_covariance(const std::function<void(const CovarianceRow&)>& visit) const;
  void each_timing(const std::function<void(const TimingRow&)>& visit) const;
  /// Of camera_trajectory(), with how sure its poses are.
  void each_camera_pose(const std::function<void(const PoseCovarianceRow&)>& visit) const;
  /// Of vehicle_trajectory(), the same.
  void each_vehicle_pose(const std::function<void(const PoseCovarianceRow&)>& visit) const;
};

/// Steps of which the predicate, of a StepResult, holds.
template <class Predicate>
std::size_t count_steps(const DriveRecord& record, Predicate&& predicate) {
  return static_cast<std::size_t>(
      std::count_if(record.frames.begin(), record.frames.end(),
                    [&](const FrameResult& f) { return f.step && predicate(*f.step); }));
}

[[nodiscard]] inline std::size_t count_status(const DriveRecord& record, StepStatus status) {
  return count_steps(record, [=](const StepResult& s) { return s.status == status; });
}

}  // namespace oneac::app
