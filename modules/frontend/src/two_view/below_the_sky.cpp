#include "below_the_sky.h"

#include "oneac/geometry/angles.h"
#include "oneac/geometry/essential.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace oneac {
namespace {

// [rad] above the horizon: houses and hedges, and no cloud that is near enough to be seen drifting.
constexpr double kHighest = 3.0 * kDegree;
// As many as a consensus needs to tell traffic from what stands.
constexpr std::size_t kFewest = 60;

}  // namespace

bool creeps(const MotionPrior& expected) {
  return std::isfinite(expected.length_sigma) && expected.length < kCreeping;
}

std::vector<bool> below_the_sky(const TrackedPair& pair, const Eigen::Matrix3d& R_level_cam) {
  const double highest = std::sin(kHighest);
  std::vector<bool> below(pair.size());
  for (std::size_t i = 0; i < pair.size(); ++i) {
    const Eigen::Vector3d ray = pair.correspondences[i].x1.homogeneous().normalized();
    below[i] = R_level_cam.row(1).dot(ray) > -highest;
  }
  const auto count = static_cast<std::size_t>(std::count(below.begin(), below.end(), true));
  return count >= kFewest ? below : std::vector<bool>{};
}

TwoView with_the_sky(TwoView seen, const std::vector<bool>& told, double threshold_px) {
  const bool travels = seen.pose.t.norm() > 0.0;
  const Eigen::Matrix3d E = essential_matrix(seen.pose);
  std::vector<bool> inliers = seen.inliers;
  for (std::size_t i = 0; i < inliers.size(); ++i) {
    if (told[i]) continue;
    const Correspondence& ac = seen.pair.correspondences[i];
    const Eigen::Vector3d turned = seen.pose.R * ac.x1.homogeneous();
    const double off = travels ? std::abs(sampson_distance(E, ac.x1, ac.x2))
                               : (ac.x2 - turned.hnormalized()).norm();
    inliers[i] = off <= threshold_px / seen.focal_px;
  }
  seen.set_inliers(std::move(inliers));
  return seen;
}

}  // namespace oneac
