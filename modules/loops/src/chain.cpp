#include "chain.h"

#include "oneac/geometry/vehicle_limits.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace oneac::internal {
namespace {

// [m] of way over which an error of scale stays the same: that of the window and of the filter that
// carries the scale, whose memory is some ten keyframes.
constexpr double kScaleMemory_m = 60.0;
// [m², rad²] of a step that nothing is known of: anywhere, any heading.
constexpr double kAnywhere_m2 = 1e6, kAnyHeading = 10.0;
constexpr double kLeap_m = 1e7;  // [m] from a part to the next
// [m/s²] What no car keeps up: a fast one's 0 to 100 km/h in 5.5 s.
constexpr double kMostAcceleration = 5.0;
constexpr double kSlack_m = 5.0;  // [m]
// Of the ways on either side: two, and twice as unsure as told.
constexpr double kDriftSigmas = 4.0;
// [m] Two fixes of 10 m each, as between houses or a second late, at four of their 1σ.
constexpr double kApartByGps_m = 60.0;
constexpr double kCourseByGps = 45.0 * M_PI / 180;  // [rad] a second late in a bend
constexpr std::size_t kSpeedSteps = 5;              // to the gap: the last may be false already

Matrix6 carried(const Matrix6& covariance, const Eigen::Isometry3d& T) {
  const Matrix6 A = adjoint(T);
  return A * covariance * A.transpose();
}

bool is_known(const Matrix6& covariance) {
  return !covariance.isZero() && covariance.allFinite();
}

Matrix6 known_or_anything(const Matrix6& covariance) {
  if (is_known(covariance)) return covariance;
  Matrix6 anything = Matrix6::Zero();
  anything.diagonal().head<3>().setConstant(kAnywhere_m2);
  anything.diagonal().tail<3>().setConstant(kAnyHeading);
  return anything;
}

/// Angles become half angles, as the vector part of a quaternion has them.
Matrix6 information_of(const Matrix6& covariance) {
  Vector6 scale;
  scale << 1.0, 1.0, 1.0, 2.0, 2.0, 2.0;
  const Matrix6 information = covariance.ldlt().solve(Matrix6::Identity());
  const Matrix6 halves = scale.asDiagonal() * information * scale.asDiagonal();
  return 0.5 * (halves + halves.transpose());
}

/// T_1_2 out of T_2_1: δ = T_2_1 (exp([w]×) R, t + v)⁻¹, translation −v + w × t, rotation −w.
UncertainPose inverse_of(const RelativePose& T_2_1, const Matrix6& covariance) {
  UncertainPose pose;
  const RelativePose T_1_2 = T_2_1.inverse();
  pose.T.linear() = T_1_2.R;
  pose.T.translation() = T_1_2.t;
  Matrix6 J = Matrix6::Zero();
  J.topLeftCorner<3, 3>() = -cross_matrix(T_2_1.t);
  J.topRightCorner<3, 3>() = -Eigen::Matrix3d::Identity();
  J.bottomLeftCorner<3, 3>() = -Eigen::Matrix3d::Identity();
  pose.covariance = J * covariance * J.transpose();
  return pose;
}

}  // namespace

Matrix6 adjoint(const Eigen::Isometry3d& T) {
  Matrix6 A = Matrix6::Zero();
  A.topLeftCorner<3, 3>() = T.linear();
  A.bottomRightCorner<3, 3>() = T.linear();
  A.topRightCorner<3, 3>() = cross_matrix(T.translation()) * T.linear();
  return A;
}

Matrix6 covariance_of(const LoopKeyframe& keyframe) {
  return known_or_anything(keyframe.covariance);
}

Matrix63 shared_changes(const LoopKeyframe& keyframe) {
  Matrix63 changes = Matrix63::Zero();
  changes.bottomRows<3>() = keyframe.shared_rotation.asDiagonal();
  return changes;
}

UncertainPose inverse(const UncertainPose& a) {
  return {a.T.inverse(), carried(a.covariance, a.T)};
}

UncertainPose operator*(const UncertainPose& a, const UncertainPose& b) {
  return {a.T * b.T, carried(a.covariance, b.T.inverse()) + b.covariance};
}

Vector6 small_motion(const Eigen::Isometry3d& T) {
  const Eigen::AngleAxisd turn(T.linear());
  Vector6 motion;
  motion << T.translation(), turn.angle() * turn.axis();
  return motion;
}

UncertainPose of_loop(const LoopConstraint& loop) {
  return inverse_of(loop.T_2_1, loop.covariance);
}

void Chain::add(const LoopKeyframe& keyframe) {
  const Eigen::Isometry3d& here = keyframe.T_first_cam;
  const bool first = poses_.empty();
  const bool goes_on =
      !first && keyframe.log == stretches_.back().log && is_known(keyframe.covariance);
  Matrix6 sum = Matrix6::Zero();
  Matrix63 shared = Matrix63::Zero();
  double driven = first ? 0.0 : driven_.back() + kLeap_m;
  if (goes_on) {
    sum = sums_.back() + carried(keyframe.covariance, here);
    shared = shared_.back() + adjoint(here) * shared_changes(keyframe);
    driven = driven_.back() + (here.translation() - poses_.back().translation()).norm();
  }
  if (goes_on) {
    stretches_.back().last = poses_.size();
  } else {
    stretches_.push_back({poses_.size(), poses_.size(), keyframe.log});
  }
  parts_.push_back(stretches_.size() - 1);
  times_.push_back(keyframe.time_s);
  metric_.push_back(keyframe.metric);
  places_.push_back(keyframe.place);
  poses_.push_back(here);
  sums_.push_back(sum);
  shared_.push_back(shared);
  driven_.push_back(driven);
  scale_sigma_.push_back(keyframe.scale_sigma);
  const double begin = knots_.empty() ? 0.0 : driven_[knots_.back()];
  if (driven - begin >= kScaleMemory_m) knots_.push_back(poses_.size() - 1);
}

double Chain::fastest_between(std::size_t first, std::size_t last) const {
  double fastest = 0.0;
  for (std::size_t i = first + 1; i <= last; ++i) {
    const double seconds = times_[i] - times_[i - 1];
    if (!metric_[i] || !(seconds > 0.0)) continue;
    const double way = (poses_[i].translation() - poses_[i - 1].translation()).norm();
    fastest = std::max(fastest, way / seconds);
  }
  return fastest > 0.0 ? std::min(fastest, VehicleLimits::kFastest) : VehicleLimits::kFastest;
}

bool Chain::can_be_driven(std::size_t a, std::size_t b, const Eigen::Isometry3d& T_a_b) const {
  if (a > b) return can_be_driven(b, a, T_a_b.inverse());
  const Part& from = stretches_[parts_[a]];
  const Part& to = stretches_[parts_[b]];
  const double seconds = times_[to.first] - times_[from.last];
  if (known(a, b) || from.log != to.log || !(seconds > 0.0)) return true;
  const UncertainPose leap =
      between(from.last, a) * UncertainPose{T_a_b, Matrix6::Zero()} * between(b, to.first);
  // Faster and faster for half of the time, then slower and slower.
  const double before =
      fastest_between(from.last - std::min(kSpeedSteps, from.last - from.first), from.last);
  const double after = fastest_between(to.first, std::min(to.first + kSpeedSteps, to.last));
  const double usual = 0.5 * (before + after);
  const double most =
      std::min(usual + 0.25 * kMostAcceleration * seconds, VehicleLimits::kFastest) * seconds;
  const double drift = kDriftSigmas * std::sqrt(leap.covariance.topLeftCorner<3, 3>().trace());
  return leap.T.translation().norm() < most + kSlack_m + drift;
}

bool Chain::apart_by_gps(std::size_t a, std::size_t b, double turn) const {
  if (known(a, b) || !places_[a] || !places_[b]) return false;
  const GpsPlace &first = *places_[a], &second = *places_[b];
  if ((first.point - second.point).norm() > kApartByGps_m) return true;
  if (!first.course || !second.course) return false;
  const double between = std::abs(std::remainder(*first.course - *second.course, 2.0 * M_PI));
  return between > turn + kCourseByGps;
}

Eigen::Matrix3d Chain::scale_covariance(std::size_t a, std::size_t b) const {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  const auto add = [&](std::size_t from, std::size_t to) {
    const Eigen::Vector3d way =
        scale_sigma_[to] * (poses_[to].translation() - poses_[from].translation());
    sum += way * way.transpose();
  };
  auto knot = std::upper_bound(knots_.begin(), knots_.end(), a);
  for (; knot != knots_.end() && *knot < b; ++knot) {
    add(a, *knot);
    a = *knot;
  }
  add(a, b);
  return sum;
}

UncertainPose Chain::between(std::size_t a, std::size_t b) const {
  if (a > b) return inverse(between(b, a));
  UncertainPose pose;
  pose.T = poses_[a].inverse() * poses_[b];
  if (!known(a, b)) {
    pose.covariance = known_or_anything(Matrix6::Zero());
    return pose;
  }
  pose.covariance = carried(sums_[b] - sums_[a], poses_[b].inverse());
  const Matrix63 shared = adjoint(poses_[b].inverse()) * (shared_[b] - shared_[a]);
  pose.covariance += shared * shared.transpose();
  const Eigen::Matrix3d R = poses_[b].linear();
  pose.covariance.topLeftCorner<3, 3>() += R.transpose() * scale_covariance(a, b) * R;
  return pose;
}

}  // namespace oneac::internal

namespace oneac {

Eigen::Matrix<double, 6, 6> covariance_of_steps(const std::vector<OdometryStep>& steps) {
  internal::UncertainPose way;
  for (const OdometryStep& step : steps) {
    way = way * internal::inverse_of(step.T_2_1, step.covariance);
  }
  return way.covariance;
}

Eigen::Matrix<double, 6, 6> g2o_information(const LoopKeyframe& keyframe) {
  return internal::information_of(internal::covariance_of(keyframe));
}

Eigen::Matrix<double, 6, 6> g2o_information(const LoopConstraint& loop) {
  return internal::information_of(internal::of_loop(loop).covariance);
}

}  // namespace oneac
