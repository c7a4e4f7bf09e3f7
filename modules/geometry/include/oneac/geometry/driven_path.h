#pragma once

#include "oneac/geometry/relative_pose.h"

#include <Eigen/Core>

#include <optional>

namespace oneac {

/// The way of a vehicle that goes on turning as it did in one step, on the ground: a circle that
/// touches the levelled camera's axis. What lies beside it, the vehicle does not drive on: behind
/// the kerb of a bend begins a road of another height.
class DrivenPath {
 public:
  /// [camera heights] 1σ of such a road's height against the car's: a kerb of 12 cm.
  static constexpr double kKerb = 0.08;

  /// Straight along the axis.
  DrivenPath() = default;
  /// @param T_2_1        of the cameras, optical frames; t in any unit
  /// @param R_level_cam  of the first; straight where it does not look along its way, or not
  /// against
  ///                     it, within 25°
  DrivenPath(const RelativePose& T_2_1, const Eigen::Matrix3d& R_level_cam);

  /// X of the way at Z, in the levelled first camera's frame, in the unit of t; nothing where the
  /// way has turned off before.
  [[nodiscard]] std::optional<double> at(double z) const;

 private:
  double curvature_ = 0.0;  ///< [1/unit of t] to the right
};

}  // namespace oneac
