#pragma once

#include <Eigen/Core>

namespace oneac {

/// A vehicle has inertia: how fast it turns changes by little from step to step. A rotation that
/// needs more is that of a wrong basin.
class TurnGate {
 public:
  /// Whether the rotation of a step between two times [s] can follow those before. What is allowed
  /// is remembered; after a second of refusals anything is, as then the memory was wrong.
  [[nodiscard]] bool allows(const Eigen::Matrix3d& R_2_1, double begin_s, double end_s);

 private:
  bool known_ = false;
  Eigen::Vector3d rate_ = Eigen::Vector3d::Zero();  ///< [rad/s] of the step allowed last
  double time_s_ = 0.0;                             ///< [s] of its middle
};

}  // namespace oneac
