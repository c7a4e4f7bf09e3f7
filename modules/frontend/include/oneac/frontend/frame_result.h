#pragma once

#include "oneac/frontend/keyframe.h"
#include "oneac/frontend/tilt_belief.h"
#include "oneac/geometry/relative_pose.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <string>

namespace oneac {

/// How a step came about.
enum class StepStatus {
  kOk,         ///< estimated from the images
  kNoMotion,   ///< estimated: the camera stood, or turned on the spot
  kPredicted,  ///< the images did not carry it: the last motion goes on
};
[[nodiscard]] const char* to_string(StepStatus status);

/// The motion from the frame before to this one.
struct StepResult {
  std::size_t index1 = 0, index2 = 0;  ///< images of the camera in the log
  double time1 = 0.0, time2 = 0.0;     ///< [s] Unix time
  StepStatus status = StepStatus::kPredicted;
  /// The second image shows once more what the first did: all that moved before rests, and the car
  /// cannot have stopped, or nobody knows its speed. A video at another rate than its camera's.
  /// Then `pose` is that of the images, no motion, and nobody knows where the car was at time2; not
  /// metric.
  bool repeats_image = false;
  /// T_2_1 of the two images alone, optical frames; t in metres when metric, else |t| is 1 or 0
  RelativePose pose;
  bool metric = false;  ///< t is in metres: the scale is known well enough, or the car stood
  double length = 0.0;  ///< [m, or units while the drive has no scale] step used in the trajectory
  double length_sigma = 0.0;  ///< relative 1σ of a metric length
  double camera_doubt = 0.0;  ///< of it, the part by a focal length that bends contradict
  /// Of (w, t) with t as in `pose`, in the second camera's frame: R ← exp([w]×) R, t ← t + v [rad²,
  /// m² where metric]; without metres it says nothing along t. Symmetric, positive semidefinite.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  std::size_t acs = 0;         ///< affine correspondences of the pair
  std::size_t inliers = 0;     ///< of them that obey the pose
  std::size_t ground_acs = 0;  ///< on the road, where the road was last measured in this step
  std::size_t landmarks = 0;   ///< of the map that carried the length; 0: another source did
  std::string fault;           ///< of the initialiser's answer, which was not used; "" as a rule
  std::size_t segment = 0;     ///< raised when tracking had to start anew
  double features_ms = 0.0, estimate_ms = 0.0, refine_ms = 0.0;  ///< CPU time [ms]
};

/// Pose of one frame and how it came about.
struct FrameResult {
  std::size_t index = 0;
  double time_s = 0.0;
  /// Camera in the first camera's frame, as known now; the final one is in `settled` of a later
  /// result.
  Eigen::Isometry3d T_first_cam = Eigen::Isometry3d::Identity();
  /// The same by the steps alone, one after the other as each was told when it came: it drifts, but
  /// never jumps and is never corrected (`odom` of ROS, where T_first_cam is `map`).
  Eigen::Isometry3d T_odom_cam = Eigen::Isometry3d::Identity();
  /// What lengths of the past were multiplied with when this frame came; 1: they are as before.
  double rescaled = 1.0;
  std::optional<StepResult> step;  ///< none for the first frame
  TiltBelief tilt;         ///< of the camera on the vehicle, as believed now: changes slowly
  AngleBelief suspension;  ///< [rad] pitch up that the springs add in this frame, against the road
  std::optional<std::size_t> keyframe;  ///< id, when this frame became a keyframe
  Settled settled;                      ///< what this frame made final
};

}  // namespace oneac
