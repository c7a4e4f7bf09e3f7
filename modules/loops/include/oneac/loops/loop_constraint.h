#pragma once

#include "oneac/geometry/relative_pose.h"
#include "oneac/loops/shared_patch.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace oneac {

/// Two keyframes that saw one place: a measured motion between them, in metres.
struct LoopConstraint {
  std::size_t first = 0, second = 0;  ///< keyframes in the order of their adding; first < second
  RelativePose T_2_1;                 ///< X2 = R X1 + t [m]
  /// Of (w, t): R ← exp([w]×) R, t ← t + v, in the second camera's frame [rad², m²].
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  double sigma_length = 0.0;  ///< 1σ of |t| [m]; of the position across where t is nearly zero
  std::size_t inliers = 0;    ///< correspondences with a landmark that obey the motion
  std::size_t acs = 0;        ///< affine correspondences of the two images
  /// What the inliers are in the keyframes of both ends, `first` before its neighbours, `second`
  /// and its own; when they were asked for.
  std::vector<SharedPatch> patches;
};

/// Information of T_1_2 as g2o wants it: translation, then the vector part of the quaternion, of a
/// change on the right. @pre the covariance is positive definite
[[nodiscard]] Eigen::Matrix<double, 6, 6> g2o_information(const LoopConstraint& loop);

}  // namespace oneac
