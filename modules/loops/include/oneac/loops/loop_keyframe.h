#pragma once

#include "oneac/geometry/relative_pose.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <vector>

namespace oneac {

/// Where a GPS had the vehicle.
struct GpsPlace {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< in one frame for all logs [m]
  std::optional<double> course;  ///< of travel, in one sense from one direction [rad]; if known
};

/// A keyframe as loops need it: a value of the odometry, frontend's Keyframe without its points.
struct LoopKeyframe {
  std::size_t id = 0;       ///< what the odometry calls it
  std::size_t index = 0;    ///< image of the camera in the log
  double time_s = 0.0;      ///< [s]
  std::size_t segment = 0;  ///< raised when tracking had to start anew
  std::size_t log = 0;      ///< which of several drives, in their order; T_first_cam is of its own
  bool metric = false;      ///< lengths of the segment are metres here
  Eigen::Isometry3d T_first_cam = Eigen::Isometry3d::Identity();
  /// Of T_before_this: translation [m²], then the rotation vector [rad²], of a change on the right;
  /// see covariance_of_steps(). Zero where nothing is known, and for the first of a log: then a
  /// part of the way begins, which only loops can join to the others.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  /// [rad] 1σ of what the turn of T_before_this, about the axes of this camera, has wrong as all
  /// steps of a drive have; beside `covariance`.
  Eigen::Vector3d shared_rotation = Eigen::Vector3d::Zero();
  double scale_sigma = 0.0;       ///< relative 1σ of lengths here, shared by neighbours
  std::optional<GpsPlace> place;  ///< only ever refuses a loop
};

/// A step of the odometry.
struct OdometryStep {
  RelativePose T_2_1;  ///< X2 = R X1 + t [m]
  /// Of (w, t): R ← exp([w]×) R, t ← t + v.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

/// What the errors of independent steps add up to, as LoopKeyframe has it. The window's own
/// information will not do: it is that of a keyframe whose landmarks are known, and adds up to a
/// fraction of the drift.
[[nodiscard]] Eigen::Matrix<double, 6, 6> covariance_of_steps(
    const std::vector<OdometryStep>& steps);

/// The information of T_before_this as g2o wants it: translation, then the vector part of the
/// quaternion; next to nothing where nothing is known.
[[nodiscard]] Eigen::Matrix<double, 6, 6> g2o_information(const LoopKeyframe& keyframe);

}  // namespace oneac
