#include "math/usable.h"
#include "one_ac/pitched_essential.h"

#include "oneac/geometry/triangulation.h"
#include "oneac/solvers/relpose_1ac_planar_pitch.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

namespace oneac {
namespace {

using internal::Angles;
using internal::Essential;
using Gram9 = Eigen::Matrix<double, 9, 9>;

constexpr std::size_t kStarts = 16;  // minimal solutions tried by the least-squares form
constexpr int kDescentSteps = 30;
constexpr double kDescentStep = 1e-12;  // [rad]

/// Levenberg-Marquardt on eᵀ G e over the three angles.
double descend(const Gram9& gram, Angles& angles) {
  Essential at_angles(angles);
  double cost = at_angles.e.dot(gram * at_angles.e);
  const double rounding = 1e-16 * gram.trace();  // costs that differ by less are equal
  double damping = 1e-6;
  for (int step = 0; step < kDescentSteps; ++step) {
    const Eigen::Matrix<double, 9, 3>& J = at_angles.J;
    Eigen::Matrix3d N = J.transpose() * gram * J;
    const Eigen::Vector3d gradient = J.transpose() * (gram * at_angles.e);
    N.diagonal() *= 1.0 + damping;
    const Eigen::Vector3d delta = N.ldlt().solve(gradient);
    if (!delta.allFinite()) break;
    const Angles next{angles.alpha - delta.x(), angles.heading - delta.y(),
                      angles.pitch - delta.z()};
    const Essential at_next(next);
    const double next_cost = at_next.e.dot(gram * at_next.e);
    if (next_cost <= cost + rounding) {
      angles = next;
      at_angles = at_next;
      cost = std::min(cost, next_cost);
      damping *= 0.1;
      if (delta.norm() < kDescentStep) break;
    } else {
      damping = std::max(damping * 10.0, 1e-9);
      if (damping > 1e6) break;
    }
  }
  return cost;
}

/// Sum over the correspondences of cheirality's vote; flips t to the side of the majority.
[[nodiscard]] bool resolve_sign(PitchedPose& pose, AcSpan acs, const double* weights) {
  int votes = 0, voters = 0;
  const RelativePose T = pose.pose();
  for (std::size_t i = 0; i < acs.size(); ++i) {
    if (!internal::is_usable(acs[i]) || (weights != nullptr && !(weights[i] > 0.0))) continue;
    const int vote = cheirality(T, acs[i].x1, acs[i].x2);
    votes += vote;
    voters += std::abs(vote);
  }
  if (votes < 0) pose.planar.tx = -pose.planar.tx, pose.planar.tz = -pose.planar.tz;
  return voters > 0;
}

}  // namespace

SolutionSet<PitchedPose, 1> relpose_nac_planar_pitch(AcSpan acs, const double* weights,
                                                     double max_pitch) {
  Gram9 gram = Gram9::Zero();
  for (std::size_t i = 0; i < acs.size(); ++i) {
    const double weight = weights == nullptr ? 1.0 : weights[i];
    if (!(weight > 0.0) || !internal::is_usable(acs[i])) continue;
    const Eigen::Matrix<double, 3, 9> rows = internal::epipolar_rows(acs[i]);
    gram.noalias() += weight * rows.transpose() * rows;
  }
  if (!(gram.trace() > 0.0) || !gram.allFinite()) return {};
  std::optional<PitchedPose> best;
  double least = 0.0;
  std::size_t starts = 0;
  for (std::size_t i = 0; i < acs.size() && starts < kStarts; ++i) {
    if (weights != nullptr && !(weights[i] > 0.0)) continue;
    const auto candidates = relpose_1ac_planar_pitch(acs[i], max_pitch);
    starts += candidates.empty() ? 0 : 1;
    for (const PitchedPose& start : candidates) {
      Angles angles{std::atan2(start.planar.sin_alpha, start.planar.cos_alpha),
                    std::atan2(start.planar.tx, start.planar.tz), start.pitch};
      const double cost = descend(gram, angles);
      if (!std::isfinite(cost) || (best && !(cost < least))) continue;
      least = cost;
      best = angles.pose();
    }
  }
  if (!best || !resolve_sign(*best, acs, weights)) return {};
  return *best;
}

}  // namespace oneac
