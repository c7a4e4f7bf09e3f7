#include "turn_gate.h"

#include <Eigen/Geometry>

#include <cmath>

namespace oneac {
namespace {

// [rad/s²] Steering turns a car by less; half a turn a second is reached in a second by none.
constexpr double kAcceleration = 5.0;
// [rad/s] that springs and bumps add at once: a degree within 35 ms.
constexpr double kBump = 0.5;
// [rad/s] 70° a second: a car at full lock, or sliding, turns no faster.
constexpr double kFastest = 1.2;
// [s] a rate older than this says nothing.
constexpr double kMemory = 1.0;

}  // namespace

bool TurnGate::allows(const Eigen::Matrix3d& R_2_1, double begin_s, double end_s) {
  const double seconds = end_s - begin_s, middle = 0.5 * (begin_s + end_s);
  if (!(seconds > 0.0) || !R_2_1.allFinite()) return true;
  const Eigen::AngleAxisd turn(R_2_1);
  const Eigen::Vector3d rate = turn.angle() / seconds * turn.axis();
  const double age = middle - time_s_;
  const bool possible =
      rate.norm() <= kFastest && (rate - rate_).norm() <= kBump + kAcceleration * age;
  if (known_ && age < kMemory && !possible) return false;
  known_ = true;
  rate_ = rate;
  time_s_ = middle;
  return true;
}

}  // namespace oneac
