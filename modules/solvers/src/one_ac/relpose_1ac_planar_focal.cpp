#include "oneac/solvers/relpose_1ac_planar_focal.h"

#include "math/sign_vote.h"
#include "planes/planar_entries.h"

#include <cmath>

namespace oneac {
namespace {

// Shares of the entries' squares in their differences that are rounding: no turn, or a circle.
constexpr double kUndetermined = 1e-10;

[[nodiscard]] bool is_within(double focal, double max_ratio) {
  return focal <= max_ratio && focal * max_ratio >= 1.0;
}

/// f² = (F32² − F23²) / (F21² − F12²); zero when it is not positive or not determined.
[[nodiscard]] double squared_focal(const Eigen::Vector4d& F) {
  const Eigen::Vector4d q = F.cwiseAbs2();
  const double below = q(1) - q(0), above = q(3) - q(2);
  const bool determined = std::abs(below) > kUndetermined * (q(1) + q(0)) &&
                          std::abs(above) > kUndetermined * (q(3) + q(2));
  const double squared = above / below;
  return determined && squared > 0.0 && std::isfinite(squared) ? squared : 0.0;
}

[[nodiscard]] SolutionSet<PlanarFocalPose, 1> pose_of(const Eigen::Vector4d& F, AcSpan acs,
                                                      const double* weights, double max_ratio) {
  const double squared = squared_focal(F);
  if (!(squared > 0.0)) return {};
  const double f = std::sqrt(squared);
  if (!is_within(f, max_ratio)) return {};
  const Eigen::Vector4d E(f * F(0), f * F(1), F(2), F(3));  // over f, which E's scale takes up
  auto pose = internal::pose_from_entries(E);
  if (!pose) return {};
  const internal::SignVote vote(pose->pose(), acs, weights, 1.0 / f);
  if (vote.voters == 0) return {};
  if (vote.balance < 0) pose->tx = -pose->tx, pose->tz = -pose->tz;
  const double e21 = pose->tz * pose->cos_alpha - pose->tx * pose->sin_alpha;
  return PlanarFocalPose{*pose, f, std::abs(e21 * e21 - pose->tz * pose->tz)};
}

}  // namespace

SolutionSet<PlanarFocalPose, 1> relpose_1ac_planar_focal(const AffineCorrespondence& ac,
                                                         double max_ratio) {
  if (!internal::is_usable(ac)) return {};
  const auto F = internal::entries_of(ac);
  if (!F) return {};
  return pose_of(*F, AcSpan(&ac, 1), nullptr, max_ratio);
}

SolutionSet<PlanarFocalPose, 1> relpose_nac_planar_focal(AcSpan acs, const double* weights,
                                                         double max_ratio) {
  if (const auto i = internal::only_one(acs, weights)) {
    return relpose_1ac_planar_focal(acs[*i], max_ratio);
  }
  const auto F = internal::entries_of(acs, weights);
  if (!F) return {};
  return pose_of(*F, acs, weights, max_ratio);
}

}  // namespace oneac
