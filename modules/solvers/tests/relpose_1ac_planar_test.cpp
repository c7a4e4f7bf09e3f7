#include "oneac/solvers/relpose_1ac_planar.h"

#include "solver_test_tools.h"

#include "oneac/geometry/essential.h"
#include "oneac/test_support/allocation_counter.h"

#include <gtest/gtest.h>

#include <vector>

namespace oneac {
namespace {

using namespace test;

struct Case {
  RelativePose T;
  AffineCorrespondence ac;
};

/// A point at a useful distance from the horizon, where the solver is defined.
AffineCorrespondence off_horizon(SceneGenerator& scene, const RelativePose& T) {
  for (;;) {
    AffineCorrespondence ac = scene.on_plane(T, scene.any_plane());
    if (std::abs(ac.x1.y()) > 0.02) return ac;
  }
}

Case any_case(SceneGenerator& scene) {
  const RelativePose T = scene.planar_motion();
  return {T, off_horizon(scene, T)};
}

Eigen::Vector3d equations(const RelativePose& T, const AffineCorrespondence& ac) {
  const Eigen::Matrix3d E = essential_matrix(T);
  Eigen::Vector3d r;
  r << ac.x2.homogeneous().dot(E * ac.x1.homogeneous()), affine_epipolar_residual(E, ac);
  return r;
}

TEST(Relpose1acPlanar, TruthHasFourEntriesAndSatisfiesTheEquations) {
  SceneGenerator scene(1);
  for (int i = 0; i < 1000; ++i) {
    const Case c = any_case(scene);
    const Eigen::Matrix3d E = essential_matrix(c.T);
    EXPECT_EQ(std::abs(E(0, 0)) + std::abs(E(0, 2)) + std::abs(E(1, 1)) + std::abs(E(2, 0)) +
                  std::abs(E(2, 2)),
              0.0);
    EXPECT_NEAR(E(1, 0), c.T.t.z() * cos_of(c.T) - c.T.t.x() * sin_of(c.T), 1e-15);
    EXPECT_NEAR(E(1, 2), -c.T.t.z() * sin_of(c.T) - c.T.t.x() * cos_of(c.T), 1e-15);
    EXPECT_LT(equations(c.T, c.ac).norm(), 1e-12) << "scene " << i << " of seed 1";
  }
}

TEST(Relpose1acPlanar, RecoversThousandScenesOnAnyPlane) {
  SceneGenerator scene(2);
  for (int i = 0; i < 1000; ++i) {
    const Case c = any_case(scene);
    const auto found = relpose_1ac_planar(c.ac);
    ASSERT_EQ(found.size(), 1u) << "scene " << i << " of seed 2";
    EXPECT_LT(pose_error(found[0].pose(), c.T), kExact) << "scene " << i << " of seed 2";
    EXPECT_NEAR(found[0].pose().t.norm(), 1.0, 1e-14);
    EXPECT_LT(equations(found[0].pose(), c.ac).norm(), 1e-10);
  }
}

TEST(Relpose1acPlanar, RecoversFromManyCorrespondencesOnDifferentPlanes) {
  SceneGenerator scene(3);
  for (int i = 0; i < 200; ++i) {
    const RelativePose T = scene.planar_motion();
    const int count = 1 + i % 8;
    std::vector<AffineCorrespondence> acs;
    acs.reserve(static_cast<std::size_t>(count));
    for (int k = 0; k < count; ++k) acs.push_back(off_horizon(scene, T));
    const auto found = relpose_nac_planar(acs);
    ASSERT_EQ(found.size(), 1u) << "scene " << i << " of seed 3";
    EXPECT_LT(pose_error(found[0].pose(), T), kExact) << "scene " << i << " of seed 3";
  }
}

TEST(Relpose1acPlanar, SwappedViewsGiveTheInverseMotion) {
  SceneGenerator scene(4);
  for (int i = 0; i < 200; ++i) {
    const Case c = any_case(scene);
    const auto found = relpose_1ac_planar(swapped(c.ac));
    ASSERT_EQ(found.size(), 1u);
    EXPECT_LT(pose_error(found[0].pose(), c.T.inverse()), kExact);
  }
}

TEST(Relpose1acPlanar, FaultyCorrespondencesGiveNothing) {
  SceneGenerator scene(5);
  const Case c = any_case(scene);
  for (const Fault& fault : faults(c.ac)) {
    EXPECT_TRUE(relpose_1ac_planar(fault.ac).empty()) << fault.name;
    EXPECT_TRUE(relpose_nac_planar(AcSpan(&fault.ac, 1)).empty()) << fault.name;
  }
  EXPECT_TRUE(relpose_nac_planar(AcSpan()).empty());
}

TEST(Relpose1acPlanar, PureRotationGivesNothingAtAnyAngle) {
  SceneGenerator scene(6);
  for (int i = 0; i < 1000; ++i) {
    const auto ac = pure_rotation(scene.uniform(-0.5, 0.5), scene.image_point());
    EXPECT_TRUE(relpose_1ac_planar(ac).empty()) << "case " << i << " of seed 6";
    EXPECT_TRUE(relpose_nac_planar(AcSpan(&ac, 1)).empty()) << "case " << i << " of seed 6";
  }
}

TEST(Relpose1acPlanar, HorizonGivesNothing) {
  SceneGenerator scene(7);
  for (int i = 0; i < 100; ++i) {
    const RelativePose T = scene.planar_motion();
    const Plane plane{Eigen::Vector3d(0.3, 0.4, 0.9).normalized(), 10.0};
    const AffineCorrespondence ac = on_horizon(T, plane, scene.uniform(-0.5, 0.5));
    EXPECT_TRUE(relpose_1ac_planar(ac).empty());
    EXPECT_TRUE(relpose_nac_planar(AcSpan(&ac, 1)).empty());
  }
}

TEST(Relpose1acPlanar, NeverReturnsNaNOnExtremeNumbers) {
  SceneGenerator scene(8);
  for (int i = 0; i < 20000; ++i) {
    const AffineCorrespondence ac = extreme_correspondence(scene);
    for (const PlanarPose& pose : relpose_1ac_planar(ac)) {
      EXPECT_TRUE(pose.pose().is_finite()) << "case " << i << " of seed 8";
    }
    for (const PlanarPose& pose : relpose_nac_planar(AcSpan(&ac, 1))) {
      EXPECT_TRUE(pose.pose().is_finite()) << "case " << i << " of seed 8";
    }
  }
}

TEST(Relpose1acPlanar, WeightZeroRemovesAnOutlier) {
  SceneGenerator scene(9);
  const RelativePose T = scene.planar_motion();
  std::vector<AffineCorrespondence> acs;
  acs.reserve(5);
  for (int k = 0; k < 5; ++k) acs.push_back(off_horizon(scene, T));
  acs[1] = scene.with_noise(acs[1], 0.1, 0.5);
  const std::vector<double> weights{1.0, 0.0, 1.0, 2.0, 1.0};
  const auto found = relpose_nac_planar(acs, weights.data());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_LT(pose_error(found[0].pose(), T), kExact);
  EXPECT_GT(pose_error(relpose_nac_planar(acs)[0].pose(), T), kExact);
}

TEST(Relpose1acPlanar, DoesNotAllocate) {
  SceneGenerator scene(10);
  const Case c = any_case(scene);
  const std::size_t before = allocation_count();
  const auto found = relpose_1ac_planar(c.ac);
  const auto again = relpose_nac_planar(AcSpan(&c.ac, 1));
  EXPECT_EQ(allocation_count(), before);
  EXPECT_EQ(found.size() + again.size(), 2u);
}

}  // namespace
}  // namespace oneac
