#include "oneac/robust/point_set.h"

#include "oneac/geometry/essential.h"
#include "oneac/robust/degeneracy.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace oneac {
namespace {

constexpr double kThreshold = 2e-3;
constexpr double kNever = std::numeric_limits<double>::infinity();

/// 101 correspondences (no multiple of the vector width), a third of them outliers.
std::vector<AffineCorrespondence> mixed_scene(SceneGenerator& scene, const RelativePose& T) {
  std::vector<AffineCorrespondence> acs;
  for (int i = 0; i < 101; ++i) {
    acs.push_back(scene.with_noise(scene.on_plane(T, scene.any_plane()), 5e-4, 0.0));
    if (i % 3 == 0) acs.back().x2 = scene.image_point();
  }
  return acs;
}

TEST(MsacCost, IsTheTruncatedSumOfSquaredSampsonDistances) {
  SceneGenerator scene(1);
  const RelativePose T = scene.general_motion();
  const auto acs = mixed_scene(scene, T);
  const Eigen::Matrix3d E = essential_matrix(T);
  double expected = 0.0;
  for (const auto& ac : acs) {
    const double r = sampson_distance(E, ac.x1, ac.x2) / kThreshold;
    expected += std::min(1.0, r * r);
  }
  EXPECT_NEAR(msac_cost(E, PointSet(acs), kThreshold, kNever), expected, 1e-3 * expected);
}

TEST(MsacCost, DoesNotDependOnTheScaleOfE) {
  SceneGenerator scene(2);
  const RelativePose T = scene.general_motion();
  const PointSet points(mixed_scene(scene, T));
  const Eigen::Matrix3d E = essential_matrix(T);
  EXPECT_NEAR(msac_cost(7.0 * E, points, kThreshold, kNever),
              msac_cost(E, points, kThreshold, kNever), 1e-3);
}

TEST(MsacCost, GivesUpOnceTheBarIsReached) {
  SceneGenerator scene(3);
  std::vector<AffineCorrespondence> acs(640);
  for (auto& ac : acs) ac = {scene.image_point(), scene.image_point(), Eigen::Matrix2d::Identity()};
  const double cost =
      msac_cost(essential_matrix(scene.general_motion()), PointSet(acs), kThreshold, 10.0);
  EXPECT_GE(cost, 10.0);
  EXPECT_LT(cost, 100.0);  // not all 640 were looked at
}

TEST(Conclude, CountsThoseWithinTheThresholdAndTheirCost) {
  SceneGenerator scene(4);
  RelativePose T = scene.general_motion();
  T.t.normalize();
  const auto acs = mixed_scene(scene, T);
  RobustResult result;
  complete_result(T, acs, kThreshold, result);
  ASSERT_EQ(result.inliers.size(), acs.size());
  const Eigen::Matrix3d E = essential_matrix(result.pose);
  std::size_t inliers = 0;
  for (std::size_t i = 0; i < acs.size(); ++i) {
    const double r = std::abs(sampson_distance(E, acs[i].x1, acs[i].x2));
    EXPECT_EQ(result.inliers[i], r <= kThreshold) << i;
    inliers += r <= kThreshold ? 1 : 0;
    const bool right = i % 3 != 0;  // noise of a quarter of the threshold
    EXPECT_TRUE(result.inliers[i] || !right) << i;
  }
  EXPECT_EQ(result.inlier_count, inliers);
  EXPECT_NEAR(result.cost, msac_cost(E, PointSet(acs), kThreshold, kNever), 1e-3 * result.cost);
}

}  // namespace
}  // namespace oneac
