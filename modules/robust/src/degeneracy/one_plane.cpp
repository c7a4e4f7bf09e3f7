#include "degeneracy/one_plane.h"

#include "oneac/geometry/angular_errors.h"
#include "oneac/solvers/homography_decomposition.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace oneac::internal {
namespace {

constexpr int kIterations = 5;  // of the reweighting; the plane of most points converges in three
// Share of the inliers that has to lie on the plane: a handful of points beside it, each with a
// parallax of its own, already decides between the two poses.
constexpr double kPlaneShare = 0.95;
// Poses closer than this are one [rad]: the translation runs along the plane's normal.
constexpr double kSamePose = 1e-4;

// Inliers looked at: enough to see 5 % of them beside the plane, for a bounded time.
constexpr std::size_t kLookedAt = 128;

// A few of them tell most scenes from a plane: with 95 % on it a plane has fewer than 24 of 32
// points once in fifty thousand times.
constexpr std::size_t kGlance = 32;
constexpr double kGlanceShare = 0.75;

/// At most `count` inliers, evenly spaced.
std::vector<AffineCorrespondence> some_inliers(AcSpan acs, const std::vector<bool>& inliers,
                                               std::size_t count) {
  const auto all = static_cast<std::size_t>(std::count(inliers.begin(), inliers.end(), true));
  const std::size_t wanted = std::min(count, all);
  std::vector<AffineCorrespondence> some;
  some.reserve(wanted);
  for (std::size_t i = 0, seen = 0; some.size() < wanted; ++i) {
    if (inliers[i] && seen++ == some.size() * all / wanted) some.push_back(acs[i]);
  }
  return some;
}

/// x2 of a point of the plane, minus the measured one. Its derivative with respect to m is
/// by_depth x1ᵀ.
struct Transfer {
  Eigen::Vector3d x1;
  Eigen::Vector2d r;
  Eigen::Vector2d by_depth;
};

std::optional<Transfer> transfer(const RelativePose& T, const Eigen::Vector3d& m,
                                 const AffineCorrespondence& ac) {
  const Eigen::Vector3d x = ac.x1.homogeneous();
  const Eigen::Vector3d y = T.R * x + T.t * m.dot(x);
  if (!(y.z() > 1e-6)) return std::nullopt;
  const Eigen::Vector2d projected = y.head<2>() / y.z();
  return Transfer{x, projected - ac.x2, (T.t.head<2>() - projected * T.t.z()) / y.z()};
}

Eigen::Vector3d fit_plane(const RelativePose& T, AcSpan acs, double threshold) {
  Eigen::Vector3d m = Eigen::Vector3d::Zero();
  double scale = 32.0 * threshold;  // from the plane at infinity, halved to the threshold
  for (int iteration = 0; iteration < kIterations; ++iteration, scale /= 2.0) {
    Eigen::Matrix3d H = 1e-12 * Eigen::Matrix3d::Identity();
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    for (const AffineCorrespondence& ac : acs) {
      const auto e = transfer(T, m, ac);
      if (!e) continue;
      const double share = scale * scale / (e->r.squaredNorm() + scale * scale);
      const Eigen::Vector3d weighted = share * share * e->x1;
      H += (e->by_depth.squaredNorm() * weighted) * e->x1.transpose();
      g += e->by_depth.dot(e->r) * weighted;
    }
    const Eigen::Vector3d step = -H.ldlt().solve(g);
    if (!step.allFinite()) break;
    m += step;
  }
  return m;
}

/// The plane of at least `share` of the points.
std::optional<Eigen::Vector3d> plane_of(const RelativePose& T_2_1,
                                        const std::vector<AffineCorrespondence>& points,
                                        double threshold, double share) {
  if (points.empty()) return std::nullopt;
  const Eigen::Vector3d m = fit_plane(T_2_1, points, threshold);
  std::size_t on_plane = 0;
  for (const AffineCorrespondence& ac : points) {
    const auto e = transfer(T_2_1, m, ac);
    // Two coordinates are measured here, across and along the epipolar line.
    if (e && e->r.norm() <= std::sqrt(2.0) * threshold) ++on_plane;
  }
  if (static_cast<double>(on_plane) < share * static_cast<double>(points.size())) {
    return std::nullopt;
  }
  return m;
}

}  // namespace

std::optional<Eigen::Vector3d> common_plane(const RelativePose& T_2_1, AcSpan acs,
                                            const std::vector<bool>& inliers, double threshold) {
  if (!plane_of(T_2_1, some_inliers(acs, inliers, kGlance), threshold, kGlanceShare)) {
    return std::nullopt;
  }
  return plane_of(T_2_1, some_inliers(acs, inliers, kLookedAt), threshold, kPlaneShare);
}

std::optional<RelativePose> twin_pose(const RelativePose& T_2_1, const Eigen::Vector3d& m,
                                      AcSpan acs, const std::vector<bool>& inliers) {
  const std::vector<AffineCorrespondence> on_plane = some_inliers(acs, inliers, kLookedAt);
  const Eigen::Matrix3d H = T_2_1.R + T_2_1.t * m.transpose();
  for (const PlanePose& candidate : poses_from_homography(H, on_plane)) {
    if (rotation_error(candidate.motion.R, T_2_1.R) < kSamePose) continue;
    if (!(candidate.motion.t.norm() > 0.0)) continue;
    return RelativePose{candidate.motion.R, candidate.motion.t.normalized()};
  }
  return std::nullopt;
}

}  // namespace oneac::internal
