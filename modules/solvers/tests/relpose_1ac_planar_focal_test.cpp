#include "oneac/solvers/relpose_1ac_planar_focal.h"

#include "point_solver_tools.h"

#include "oneac/solvers/relpose_1ac_planar.h"
#include "oneac/test_support/allocation_counter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace oneac {
namespace {

using namespace test;

constexpr double kFocal_px = 718.0;

AffineCorrespondence off_horizon(SceneGenerator& scene, const RelativePose& T) {
  for (;;) {
    AffineCorrespondence ac = scene.on_plane(T, scene.any_plane());
    if (std::abs(ac.x1.y()) > 0.02) return ac;
  }
}

/// What an image says: pixels about the principal point.
AffineCorrespondence in_pixels(const AffineCorrespondence& ac, double focal = kFocal_px) {
  return {focal * ac.x1, focal * ac.x2, ac.A};
}

double heading_of(const RelativePose& T) {
  return std::atan2(T.t.x(), T.t.z());
}

/// |sin α sin(2η + α)| of a motion.
double strength_of(const RelativePose& T) {
  const double alpha = std::atan2(sin_of(T), cos_of(T));
  return std::abs(std::sin(alpha) * std::sin(2.0 * heading_of(T) + alpha));
}

TEST(Relpose1acPlanarFocal, RecoversMotionAndFocalLengthOfThousandScenesInPixels) {
  SceneGenerator scene(1);
  int missed = 0;
  for (int i = 0; i < 1000; ++i) {
    const RelativePose T = scene.planar_motion();
    const auto found = relpose_1ac_planar_focal(in_pixels(off_horizon(scene, T)));
    if (found.empty()) {
      EXPECT_LT(strength_of(T), 1e-6) << "scene " << i << " of seed 1";
      ++missed;
      continue;
    }
    const double bound = kExact * std::max(1.0, 1e-3 / strength_of(T));
    EXPECT_LT(pose_error(found[0].pose(), T), bound) << "scene " << i << " of seed 1";
    EXPECT_NEAR(found[0].focal / kFocal_px, 1.0, bound) << "scene " << i << " of seed 1";
    EXPECT_NEAR(found[0].strength, strength_of(T), 1e-9);
    EXPECT_NEAR(found[0].pose().t.norm(), 1.0, 1e-14);
  }
  EXPECT_LE(missed, 1);
}

TEST(Relpose1acPlanarFocal, AssumedFocalLengthOnlyScalesTheAnswer) {
  SceneGenerator scene(2);
  for (int i = 0; i < 200; ++i) {
    const RelativePose T = scene.planar_motion();
    const auto ac = off_horizon(scene, T);
    for (const double ratio : {0.7, 1.0, 1.4}) {
      const auto found = relpose_1ac_planar_focal(in_pixels(ac, ratio));
      ASSERT_EQ(found.size(), 1u) << "scene " << i << " of seed 2";
      const double bound = kExact * std::max(1.0, 1e-3 / strength_of(T));
      EXPECT_NEAR(found[0].focal, ratio, bound) << "scene " << i << " of seed 2";
      EXPECT_LT(pose_error(found[0].pose(), T), bound) << "scene " << i << " of seed 2";
    }
  }
}

TEST(Relpose1acPlanarFocal, MotionsThatHideTheFocalLengthGiveNothing) {
  SceneGenerator scene(3);
  for (int i = 0; i < 300; ++i) {
    RelativePose straight = scene.planar_motion();
    straight.R.setIdentity();
    EXPECT_TRUE(relpose_1ac_planar_focal(off_horizon(scene, straight)).empty())
        << "straight, scene " << i << " of seed 3";
    // A camera above the rear axle: every focal length explains it.
    const RelativePose circle = circular_motion(scene.uniform(0.02, 0.3), 1.0);
    EXPECT_TRUE(relpose_1ac_planar_focal(off_horizon(scene, circle)).empty())
        << "circle, scene " << i << " of seed 3";
  }
}

TEST(Relpose1acPlanarFocal, OnACircleEveryFocalLengthFitsTheEquations) {
  SceneGenerator scene(4);
  const auto ac = off_horizon(scene, circular_motion(0.2, 1.0));
  for (const double ratio : {0.6, 1.0, 1.7}) {
    const auto other = in_pixels(ac, ratio);  // taken for a camera of another focal length
    const auto planar = relpose_1ac_planar(other);
    ASSERT_EQ(planar.size(), 1u);
    const Eigen::Matrix3d E = essential_matrix(planar[0].pose());
    EXPECT_LT(std::abs(other.x2.homogeneous().dot(E * other.x1.homogeneous())), 1e-12) << ratio;
    EXPECT_LT(affine_epipolar_residual(E, other).norm(), 1e-12) << ratio;
  }
}

TEST(Relpose1acPlanarFocal, MaximumRatioOnlyLeavesSolutionsOut) {
  SceneGenerator scene(5);
  int kept = 0;
  for (int i = 0; i < 500; ++i) {
    const auto ac = scene.with_noise(off_horizon(scene, scene.planar_motion()), 1e-3, 2e-2);
    const auto any = relpose_1ac_planar_focal(ac);
    const auto near = relpose_1ac_planar_focal(ac, 1.5);
    const bool within = !any.empty() && any[0].focal <= 1.5 && any[0].focal >= 1.0 / 1.5;
    EXPECT_EQ(near.size(), within ? 1u : 0u) << "scene " << i << " of seed 5";
    kept += within ? 1 : 0;
  }
  EXPECT_GT(kept, 50);
}

TEST(Relpose1acPlanarFocal, ErrorOfTheFocalLengthIsTheNoiseOverTheStrength) {
  SceneGenerator scene(6);
  std::vector<double> normalised;
  for (int i = 0; i < 4000; ++i) {
    const RelativePose T = scene.planar_motion();
    const auto ac = scene.with_noise(off_horizon(scene, T), 1e-5, 1e-5);
    const auto found = relpose_1ac_planar_focal(ac);
    if (found.empty() || strength_of(T) < 3e-3) continue;
    normalised.push_back(std::abs(std::log(found[0].focal)) * found[0].strength / 1e-5);
  }
  ASSERT_GT(normalised.size(), 2000u);
  std::sort(normalised.begin(), normalised.end());
  const double median = normalised[normalised.size() / 2];
  EXPECT_GT(median, 0.3);
  EXPECT_LT(median, 30.0);
}

TEST(Relpose1acPlanarFocal, ManyCorrespondencesRecoverBothAndUseWeights) {
  SceneGenerator scene(7);
  for (int i = 0; i < 200; ++i) {
    const RelativePose T = scene.planar_motion();
    std::vector<AffineCorrespondence> acs;
    const int count = 1 + i % 8;
    for (int k = 0; k < count; ++k) acs.push_back(in_pixels(off_horizon(scene, T), 1.2));
    std::vector<double> weights(acs.size(), 1.0);
    acs.push_back(scene.with_noise(acs[0], 0.1, 0.3));
    weights.push_back(0.0);
    const auto found = relpose_nac_planar_focal(acs, weights.data());
    ASSERT_EQ(found.size(), 1u) << "scene " << i << " of seed 7";
    const double bound = 1e-7 * std::max(1.0, 1e-3 / strength_of(T));
    EXPECT_LT(pose_error(found[0].pose(), T), bound) << "scene " << i << " of seed 7";
    EXPECT_NEAR(found[0].focal, 1.2, bound) << "scene " << i << " of seed 7";
  }
}

TEST(Relpose1acPlanarFocal, FaultsAndPureRotationsGiveNothing) {
  SceneGenerator scene(8);
  const auto good = off_horizon(scene, scene.planar_motion());
  for (const Fault& fault : faults(good)) {
    EXPECT_TRUE(relpose_1ac_planar_focal(fault.ac).empty()) << fault.name;
    EXPECT_TRUE(relpose_nac_planar_focal(AcSpan(&fault.ac, 1)).empty()) << fault.name;
  }
  for (int i = 0; i < 1000; ++i) {
    const auto turned = pure_rotation(scene.uniform(-0.5, 0.5), scene.image_point());
    EXPECT_TRUE(relpose_1ac_planar_focal(turned).empty()) << "case " << i << " of seed 8";
  }
  EXPECT_TRUE(relpose_nac_planar_focal(AcSpan()).empty());
}

TEST(Relpose1acPlanarFocal, NeverReturnsNaNOnExtremeNumbers) {
  SceneGenerator scene(9);
  for (int i = 0; i < 20000; ++i) {
    const AffineCorrespondence ac = extreme_correspondence(scene);
    for (const PlanarFocalPose& pose : relpose_1ac_planar_focal(ac)) {
      EXPECT_TRUE(pose.pose().is_finite() && std::isfinite(pose.focal)) << "case " << i;
    }
  }
}

TEST(Relpose1acPlanarFocal, DoesNotAllocate) {
  SceneGenerator scene(10);
  const auto ac = off_horizon(scene, scene.planar_motion());
  const std::size_t before = allocation_count();
  const auto one = relpose_1ac_planar_focal(ac);
  const auto again = relpose_nac_planar_focal(AcSpan(&ac, 1));
  EXPECT_EQ(allocation_count(), before);
  EXPECT_EQ(one.size() + again.size(), 2u);
}

}  // namespace
}  // namespace oneac
