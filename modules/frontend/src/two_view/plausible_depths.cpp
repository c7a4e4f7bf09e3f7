#include "plausible_depths.h"

#include "two_view.h"

#include "oneac/geometry/triangulation.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace oneac {
namespace {

constexpr double kTelling = 5.0;  // [σ] a longer parallax has a depth
// A patch at z1 that comes to z2 grows by (z1 / z2)² in area when it faces the camera, by the third
// power on the road, and by more than the first however it stands. Asked of those that had to grow
// or shrink by more than their affinity is off, and for no more than half of it.
constexpr double kGrows = 0.3, kLeastPower = 0.5;  // log of z1 / z2; its power
// [camera heights] The road below the picture is half a height away at least, and so is all else.
constexpr double kNearest = 0.4;
constexpr double kSure = 2.0;       // [σ] of the length that is expected
constexpr double kMostWrong = 0.3;  // share of the inliers

/// Largest way [camera heights] that the vehicle may have gone; 0: not known.
double farthest_way(const MotionPrior& motion) {
  if (!std::isfinite(motion.length_sigma)) return 0.0;
  return std::max(0.0, motion.length + kSure * motion.length_sigma);
}

bool is_plausible(const Correspondence& ac, const RelativePose& unit, double way, double focal_px) {
  const Eigen::Vector3d rotated = unit.R * ac.x1.homogeneous();
  if (!(rotated.z() > 0.0)) return false;
  const double parallax = (ac.x2 - rotated.hnormalized()).norm();
  if (!(parallax > kTelling * std::sqrt(2.0) * point_sigma(ac, focal_px))) return true;
  const auto point = triangulate(unit, ac.x1, ac.x2);
  if (!point) return true;
  if (!point->in_front()) return false;
  const double grows = std::log(point->z1 / point->z2);
  const double grew = std::log(std::abs(ac.A.determinant()));
  if (std::abs(grows) > kGrows && !(grew / grows > kLeastPower)) return false;
  return !(point->z1 * way < kNearest && way > 0.0);
}

}  // namespace

std::vector<bool> with_plausible_depths(const TrackedPair& pair, const std::vector<bool>& inliers,
                                        const RelativePose& pose, const MotionPrior& motion,
                                        double focal_px) {
  if (!(pose.t.norm() > 0.0)) return inliers;
  const RelativePose unit{pose.R, pose.t.normalized()};
  const double way = farthest_way(motion);
  std::vector<bool> kept = inliers;
  double wrong = 0.0, all = 0.0;
  for (std::size_t i = 0; i < pair.size(); ++i) {
    if (!inliers[i]) continue;
    kept[i] = is_plausible(pair.correspondences[i], unit, way, focal_px);
    all += 1.0;
    wrong += kept[i] ? 0.0 : 1.0;
  }
  return wrong > kMostWrong * all ? inliers : kept;
}

}  // namespace oneac
