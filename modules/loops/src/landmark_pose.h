#pragma once

#include "oneac/geometry/relative_pose.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace oneac::internal {

/// A point of one view with its inverse depth, and where the other view shows it.
struct LandmarkSight {
  Eigen::Vector2d x = Eigen::Vector2d::Zero();      ///< in the landmark's view [-]
  double inverse_depth = 0.0;                       ///< [1/m]
  double inverse_depth_sigma = 0.0;                 ///< [1/m]
  Eigen::Vector2d other = Eigen::Vector2d::Zero();  ///< in the other view [-]
  bool of_first = true;                             ///< the landmark's view is the first
};

struct LandmarkPose {
  RelativePose T_2_1;          ///< [m]
  std::vector<bool> inliers;   ///< one per sight
  std::size_t first_side = 0;  ///< inliers with a landmark of the first view
  std::size_t second_side = 0;
  double cost = 0.0;  ///< Σ of squares in standard deviations, each bounded by the gate
  /// Of (w, t): R ← exp([w]×) R, t ← t + v; never less than the noise that was assumed,
  /// and with what neighbours in the image share (GradientsOfCells).
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  bool usable = false;
};

/// All six degrees of freedom by landmarks of both views: Gauss-Newton under Tukey's weights on the
/// distances in the image, each by its covariance from the noise of a point and of its landmark's
/// inverse depth.
/// @param noise  1σ of a point [-]
[[nodiscard]] LandmarkPose pose_by_landmarks(const std::vector<LandmarkSight>& sights,
                                             const RelativePose& start, double noise);

/// Length of a unit translation by the landmarks: the weighted median of what each says; zero where
/// none does.
[[nodiscard]] double length_by_landmarks(const std::vector<LandmarkSight>& sights,
                                         const RelativePose& unit);

}  // namespace oneac::internal
