#include "math/gram_descent.h"
#include "math/sign_vote.h"

#include "oneac/geometry/tangent_basis.h"
#include "oneac/solvers/relpose_1ac_vertical.h"

#include <cmath>
#include <optional>

namespace oneac {
namespace {

constexpr std::size_t kStarts = 16;  // correspondences whose minimal solutions are tried

/// E = [t]× R_yaw and its derivatives by the yaw and by t along its tangents.
struct UprightEssential {
  UprightPose pose;
  Eigen::Matrix<double, 3, 2> tangents;
  internal::Vector9 e;
  Eigen::Matrix<double, 9, 3> J;

  explicit UprightEssential(const UprightPose& of) : pose(of), tangents(tangent_basis(of.t)) {
    const double c = pose.cos_alpha, s = pose.sin_alpha;
    const Eigen::Matrix3d R = yaw_rotation(c, s);
    Eigen::Matrix3d by_yaw;
    by_yaw << -s, 0.0, -c, 0.0, 0.0, 0.0, c, 0.0, -s;
    e = packed(cross_matrix(pose.t) * R);
    J.col(0) = packed(cross_matrix(pose.t) * by_yaw);
    for (int i = 0; i < 2; ++i) J.col(i + 1) = packed(cross_matrix(tangents.col(i)) * R);
  }

  [[nodiscard]] UprightEssential moved(const Eigen::Vector3d& by) const {
    const double c = std::cos(by.x()), s = std::sin(by.x());
    return UprightEssential({pose.cos_alpha * c - pose.sin_alpha * s,
                             pose.sin_alpha * c + pose.cos_alpha * s,
                             (pose.t + tangents * by.tail<2>()).normalized()});
  }

  [[nodiscard]] static internal::Vector9 packed(const Eigen::Matrix3d& E) {
    internal::Vector9 rows;
    rows << E.row(0).transpose(), E.row(1).transpose(), E.row(2).transpose();
    return rows;
  }
};

[[nodiscard]] std::optional<UprightPose> least_squares(const internal::Gram9& gram, AcSpan acs,
                                                       const double* weights) {
  std::optional<UprightPose> best;
  double least = 0.0;
  std::size_t starts = 0;
  for (std::size_t i = 0; i < acs.size() && starts < kStarts; ++i) {
    if (!internal::counts(acs, weights, i)) continue;
    const auto candidates = relpose_1ac_vertical(acs[i]);
    starts += candidates.empty() ? 0 : 1;
    for (const UprightPose& start : candidates) {
      UprightEssential E(start);
      const double cost = internal::descend(gram, E);
      if (!std::isfinite(cost) || (best && !(cost < least))) continue;
      least = cost;
      best = E.pose;
    }
  }
  return best;
}

}  // namespace

SolutionSet<UprightPose, 4> relpose_nac_vertical(AcSpan acs, const double* weights) {
  if (const auto i = internal::only_one(acs, weights)) return relpose_1ac_vertical(acs[*i]);
  const internal::Gram9 gram = internal::epipolar_gram(acs, weights);
  if (!(gram.trace() > 0.0) || !gram.allFinite()) return {};
  auto best = least_squares(gram, acs, weights);
  if (!best) return {};
  const internal::SignVote vote(best->pose(), acs, weights);
  if (vote.voters == 0) return {};
  if (vote.balance < 0) best->t = -best->t;
  return *best;
}

}  // namespace oneac
