#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>

namespace oneac {

/// A keyframe as loops need it: a value of the odometry, frontend's Keyframe without its points.
struct LoopKeyframe {
  std::size_t id = 0;       ///< what the odometry calls it
  std::size_t index = 0;    ///< image of the camera in the log
  double time_s = 0.0;      ///< [s]
  std::size_t segment = 0;  ///< raised when tracking had to start anew
  bool metric = false;      ///< lengths of the segment are metres here
  Eigen::Isometry3d T_first_cam = Eigen::Isometry3d::Identity();
  /// Of T_before_this as g2o has it: translation, then the vector part of the quaternion, of a
  /// change on the right. Zero where nothing is known.
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  double scale_sigma = 0.0;  ///< relative 1σ of lengths here, shared by neighbours
};

}  // namespace oneac
