#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace oneac::internal {

/// A point that was expected at one place and found at another; normalised coordinates.
struct MissedPlace {
  Eigen::Vector2d expected = Eigen::Vector2d::Zero();
  Eigen::Vector2d found = Eigen::Vector2d::Zero();
  Eigen::Vector2d by_travel = Eigen::Vector2d::Zero();  ///< what of its way is the translation's
};

/// What a motion that was expected lacks: springs turn the camera, pedals change its speed. First
/// order: a place x is off by J(x) turn + speed · by_travel, J the derivative by a rotation.
struct MotionCorrection {
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();  ///< rotation vector behind the motion [rad]
  double speed = 0.0;                              ///< [-] share by which the way is longer
  double error = 0.0;  ///< [-] median of what it leaves of the places' errors

  [[nodiscard]] Eigen::Vector2d shift(const Eigen::Vector2d& x,
                                      const Eigen::Vector2d& by_travel) const;
};

/// Robust least squares over the places. Empty when too few are given.
[[nodiscard]] std::optional<MotionCorrection> correction_of(const std::vector<MissedPlace>& places);

}  // namespace oneac::internal
