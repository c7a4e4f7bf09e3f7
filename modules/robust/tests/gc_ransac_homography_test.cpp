#include "oneac/robust/gc_ransac_homography.h"

#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace oneac {
namespace {

constexpr double kThreshold = 1.0 / 700.0;

struct PlanarScene {
  std::vector<AffineCorrespondence> acs;
  Eigen::Matrix3d H;
};

/// Six of ten correspondences on one plane, the others anywhere.
PlanarScene planar_scene(std::uint64_t seed) {
  SceneGenerator scene(seed);
  const RelativePose T = scene.general_motion();
  const Plane plane = scene.any_plane();
  PlanarScene result{{}, plane_induced_homography(T, plane)};
  for (int i = 0; i < 200; ++i) {
    result.acs.push_back(scene.with_noise(scene.on_plane(T, plane), 0.3 * kThreshold, 0.005));
    if (i % 10 >= 6) result.acs.back().x2 = scene.image_point();
  }
  return result;
}

TEST(FitHomography, FindsThePlaneAmongFortyPercentOutliers) {
  for (HomographyMethod method : {HomographyMethod::k4pc, HomographyMethod::k2ac}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const PlanarScene scene = planar_scene(seed);
      const auto result = fit_homography(scene.acs, kThreshold, method, 3, {});
      ASSERT_TRUE(result.found) << seed;
      EXPECT_GE(result.inlier_count, 110U) << seed;
      EXPECT_LE(result.inlier_count, 130U) << seed;
      const Eigen::Matrix3d H = result.H / result.H.norm();
      const Eigen::Matrix3d truth = scene.H / scene.H.norm();
      EXPECT_LT(std::min((H - truth).norm(), (H + truth).norm()), 5e-3) << seed;
    }
  }
}

TEST(FitHomography, GivesTheSameBitsForTheSameSeed) {
  const PlanarScene scene = planar_scene(6);
  const auto a = fit_homography(scene.acs, kThreshold, HomographyMethod::k4pc, 3, {});
  const auto b = fit_homography(scene.acs, kThreshold, HomographyMethod::k4pc, 3, {});
  EXPECT_TRUE(a.H == b.H);
  EXPECT_EQ(a.inliers, b.inliers);
}

TEST(FitHomography, IgnoresWhatIsNotFiniteAndSaysWhenThereIsNone) {
  PlanarScene scene = planar_scene(7);
  scene.acs[0].x2.x() = std::numeric_limits<double>::quiet_NaN();
  const auto result = fit_homography(scene.acs, kThreshold, HomographyMethod::k2ac, 3, {});
  EXPECT_TRUE(result.found);
  EXPECT_FALSE(result.inliers[0]);
  EXPECT_FALSE(fit_homography({}, kThreshold, HomographyMethod::k4pc, 3, {}).found);
  EXPECT_THROW((void)fit_homography({}, 0.0, HomographyMethod::k4pc, 3, {}), std::invalid_argument);
}

}  // namespace
}  // namespace oneac
