#include "motion_correction.h"

#include "oneac/base/median.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace oneac::internal {
namespace {

using Unknowns = Eigen::Vector4d;  // turn, speed
using Rows = Eigen::Matrix<double, 2, 4>;

constexpr std::size_t kFewest = 12;  // three a number that is sought
constexpr int kRounds = 5;           // of weights: from the third on they hardly change
// [rad] and [-] 1σ of what springs and pedals do from one image to the next.
constexpr double kTurnSigma = 0.02, kSpeedSigma = 0.05;
constexpr double kLeastScale = 2e-4;  // [-] the tracker's own errors: 0.15 px at 700 px

/// Derivative of a place by the turn and the speed.
Rows derivative(const Eigen::Vector2d& at, const Eigen::Vector2d& by_travel) {
  const double x = at.x(), y = at.y();
  Rows J;
  J << -x * y, 1.0 + x * x, -y, by_travel.x(),  //
      -1.0 - y * y, x * y, x, by_travel.y();
  return J;
}

Eigen::Vector2d left_of(const MissedPlace& place, const Unknowns& now) {
  return place.found - place.expected - derivative(place.expected, place.by_travel) * now;
}

double median_left(const std::vector<MissedPlace>& places, const Unknowns& now) {
  std::vector<double> sizes;
  sizes.reserve(places.size());
  for (const MissedPlace& place : places) sizes.push_back(left_of(place, now).norm());
  return upper_median(std::move(sizes));
}

/// Least squares with Cauchy's weights at `now`.
Unknowns solved(const std::vector<MissedPlace>& places, const Unknowns& now, double scale) {
  Unknowns prior;
  prior << Eigen::Vector3d::Constant(scale / kTurnSigma), scale / kSpeedSigma;
  Eigen::Matrix4d H = prior.cwiseAbs2().asDiagonal();
  Unknowns g = Unknowns::Zero();
  for (const MissedPlace& place : places) {
    const Rows J = derivative(place.expected, place.by_travel);
    const double w = 1.0 / (1.0 + left_of(place, now).squaredNorm() / (scale * scale));
    H += w * J.transpose() * J;
    g += w * J.transpose() * (place.found - place.expected);
  }
  return H.ldlt().solve(g);
}

}  // namespace

Eigen::Vector2d MotionCorrection::shift(const Eigen::Vector2d& x,
                                        const Eigen::Vector2d& by_travel) const {
  Unknowns all;
  all << turn, speed;
  return derivative(x, by_travel) * all;
}

std::optional<MotionCorrection> correction_of(const std::vector<MissedPlace>& places) {
  if (places.size() < kFewest) return std::nullopt;
  Unknowns now = Unknowns::Zero();
  for (int i = 0; i < kRounds; ++i) {
    now = solved(places, now, std::max(median_left(places, now), kLeastScale));
  }
  if (!now.allFinite()) return std::nullopt;
  return MotionCorrection{now.head<3>(), now(3), median_left(places, now)};
}

}  // namespace oneac::internal
