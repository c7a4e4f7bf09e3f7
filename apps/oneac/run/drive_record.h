#pragma once

#include "oneac/base/image.h"
#include "oneac/evaluation/covariance_io.h"
#include "oneac/evaluation/relative_poses_io.h"
#include "oneac/evaluation/trajectory_io.h"
#include "oneac/frontend/front_end.h"
#include "oneac/rawlog/rawlog_source.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace oneac::app {

/// A stretch of time.
struct TimeSpan {
  double begin_s, end_s;  ///< [s] Unix times
};

/// What a run has computed so far: grows frame by frame and can be written at any time.
struct DriveRecord {
  std::vector<FrameResult> frames;
  std::vector<Keyframe> keyframes;  ///< settled ones, in order
  std::vector<double> decode_ms;    ///< one per frame
  SettledTracks tracks;             ///< of the keyframes; empty unless they were asked for
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
  /// Takes over what has become final.
  void take(Settled settled);
  void take(SettledTracks settled);
  /// Every length is as unsure as the camera makes it, the steps before it was known, too.
  /// @param doubt, max_uncertainty  relative 1σ, see doubt_metres() of a step
  void doubt_metres(double doubt, double max_uncertainty);
  /// Nothing is in metres, the steps before the fault was found neither.
  void withdraw_metres();
  /// The camera on the vehicle: as the log says, with the pitch and roll of `tilt`.
  [[nodiscard]] Eigen::Isometry3d mount() const;
  /// Camera trajectory of the keyframes.
  [[nodiscard]] Trajectory keyframe_trajectory() const;
  /// Camera trajectory, first camera = identity.
  [[nodiscard]] Trajectory camera_trajectory() const;
  /// Vehicle trajectory (X forward, Z up), first vehicle pose = identity; the mount is the log's
  /// with the pitch and roll of `tilt`.
  [[nodiscard]] Trajectory vehicle_trajectory() const;
  [[nodiscard]] std::vector<RelativePoseRow> relative_poses() const;
  [[nodiscard]] std::vector<CovarianceRow> covariances() const;
  /// Of camera_trajectory(), with how sure its poses are.
  [[nodiscard]] std::vector<PoseCovarianceRow> camera_poses() const;
  /// Of vehicle_trajectory(), the same.
  [[nodiscard]] std::vector<PoseCovarianceRow> vehicle_poses() const;
  [[nodiscard]] std::vector<TimingRow> timings() const;
};

}  // namespace oneac::app
