#pragma once

#include "oneac/geometry/relative_pose.h"
#include "oneac/loops/loop_constraint.h"
#include "oneac/loops/loop_keyframe.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <vector>

namespace oneac::internal {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix63 = Eigen::Matrix<double, 6, 3>;

/// T_1_2 with the covariance of (translation, rotation vector) of a change on the right.
struct UncertainPose {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  Matrix6 covariance = Matrix6::Zero();
};

[[nodiscard]] UncertainPose inverse(const UncertainPose& a);
/// T_1_3 of independent T_1_2 and T_2_3.
[[nodiscard]] UncertainPose operator*(const UncertainPose& a, const UncertainPose& b);
/// (translation, rotation vector) of a pose near the identity.
[[nodiscard]] Vector6 small_motion(const Eigen::Isometry3d& T);
/// As T_first_second.
[[nodiscard]] UncertainPose of_loop(const LoopConstraint& loop);
/// Of the step to a keyframe; of one that nothing is known of, that of anywhere.
[[nodiscard]] Matrix6 covariance_of(const LoopKeyframe& keyframe);
/// What the shared errors of rotation of the step to a keyframe change on its right, one column
/// each.
[[nodiscard]] Matrix63 shared_changes(const LoopKeyframe& keyframe);
/// Of (translation, rotation vector) on the right: through T, from its right to its left side.
[[nodiscard]] Matrix6 adjoint(const Eigen::Isometry3d& T);

/// The odometry between any two keyframes, with what adds up between them.
class Chain {
 public:
  void add(const LoopKeyframe& keyframe);

  /// T_a_b; a and b in either order. Anything between keyframes of two parts.
  [[nodiscard]] UncertainPose between(std::size_t a, std::size_t b) const;
  /// [m] driven from the start to a keyframe; between two parts farther than any car drives.
  [[nodiscard]] double driven(std::size_t keyframe) const { return driven_[keyframe]; }
  /// A part is a stretch whose odometry is known from step to step; they are numbered in order.
  [[nodiscard]] std::size_t part(std::size_t keyframe) const { return parts_[keyframe]; }
  [[nodiscard]] bool known(std::size_t a, std::size_t b) const { return parts_[a] == parts_[b]; }
  [[nodiscard]] std::size_t size() const { return poses_.size(); }
  /// Whether a car gets from one part of a log to a later one in the time between, were keyframe b
  /// at T_a_b. Of two logs, and within a part, anything is.
  [[nodiscard]] bool can_be_driven(std::size_t a, std::size_t b,
                                   const Eigen::Isometry3d& T_a_b) const;
  /// Whether GPS has two keyframes so far from each other, or under way in so different directions,
  /// that they cannot see one place; within a part odometry knows better.
  /// @param turn  [rad] from one view to the other, at most
  [[nodiscard]] bool apart_by_gps(std::size_t a, std::size_t b, double turn) const;

 private:
  /// Of lengths, [m²] of the first camera's frame: a stretch of the way is wrong by one factor.
  [[nodiscard]] Eigen::Matrix3d scale_covariance(std::size_t a, std::size_t b) const;

  struct Part {
    std::size_t first, last;  ///< keyframes
    std::size_t log;
  };
  /// [m/s] of the fastest measured step between two keyframes of a part; that of the fastest car
  /// where none was.
  [[nodiscard]] double fastest_between(std::size_t first, std::size_t last) const;

  std::vector<Part> stretches_;
  std::vector<double> times_;
  std::vector<bool> metric_;
  std::vector<std::optional<GpsPlace>> places_;
  std::vector<Eigen::Isometry3d> poses_;
  std::vector<std::size_t> parts_;
  std::vector<double> driven_;
  std::vector<double> scale_sigma_;
  std::vector<Matrix6> sums_;       ///< of a part's steps, carried to the first camera's frame
  std::vector<Matrix63> shared_;    ///< likewise of 1σ of what all steps share, one per axis
  std::vector<std::size_t> knots_;  ///< keyframes where stretches end
};

}  // namespace oneac::internal
