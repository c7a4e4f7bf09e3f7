#include "point_solver_tools.h"

#include "oneac/solvers/relpose_1pc_ackermann.h"
#include "oneac/solvers/relpose_2pc_ground.h"
#include "oneac/solvers/relpose_2pc_planar.h"
#include "oneac/solvers/relpose_3pc_vertical.h"
#include "oneac/test_support/allocation_counter.h"

#include <gtest/gtest.h>

namespace oneac {
namespace {

using namespace test;

Plane wall(SceneGenerator& scene) {
  const double delta = scene.uniform(0.5, 2.6);
  return {{std::cos(delta), 0.0, std::sin(delta)}, scene.uniform(3, 15)};
}

/// A car whose rear axle, with the camera above it, drives on a circle.
RelativePose ackermann_motion(SceneGenerator& scene) {
  const double alpha = scene.uniform(-0.3, 0.3);
  const double length = scene.uniform(-1, 1) > 0.0 ? 1.3 : -0.7;  // forwards or backwards
  return circular_motion(alpha, length);
}

TEST(Relpose2pcGround, RecoversMetricMotionOfThousandScenes) {
  SceneGenerator scene(1);
  for (int i = 0; i < 1000; ++i) {
    const RelativePose T = scene.planar_motion();
    const Plane plane = scene.ground();
    auto acs = on_one_plane(scene, T, plane, 2 + i % 4);
    while ((acs[0].x1 - acs[1].x1).norm() < 0.05) acs = on_one_plane(scene, T, plane, 2);
    const auto found = relpose_2pc_ground(acs);
    ASSERT_EQ(found.size(), 1u) << "scene " << i << " of seed 1";
    EXPECT_LT(pose_error(found[0].pose(), T), kExact) << "scene " << i << " of seed 1";
    EXPECT_LT((found[0].pose().t * plane.d - T.t).norm(), kExact) << "scene " << i << " of seed 1";
  }
}

TEST(Relpose3pcVertical, TruthIsAmongTheCandidatesWithItsNormal) {
  SceneGenerator scene(2);
  int recovered = 0;
  for (int i = 0; i < 1000; ++i) {
    const RelativePose T = scene.planar_motion();
    const Plane plane = wall(scene);
    const auto found = relpose_3pc_vertical(on_one_plane(scene, T, plane, 3 + i % 4));
    double least = 10.0;
    for (const WallPose& pose : found) {
      least = std::min(least, pose_error(pose.pose(), T) + direction_error(pose.normal(), plane.n));
    }
    recovered += least < kExact ? 1 : 0;
  }
  EXPECT_GE(recovered, 999);
}

// As on a kerb: what tells the points apart is where along the wall they are.
TEST(Relpose3pcVertical, PointsOfOneHeightInTheFirstImageWillDo) {
  SceneGenerator scene(12);
  for (int i = 0; i < 100; ++i) {
    const RelativePose T = scene.planar_motion();
    const Plane plane = wall(scene);
    std::vector<AffineCorrespondence> row;
    for (const double x : {-0.4, 0.0, 0.3}) {
      const Eigen::Vector3d ray(x, 0.25, 1.0);
      const Eigen::Vector3d X1 = ray * (plane.d / plane.n.dot(ray));
      row.push_back(in_both_views(T, X1));
    }
    EXPECT_LT(nearest_pose(relpose_3pc_vertical(row), T), kExact) << "scene " << i << " of seed 12";
  }
}

TEST(Relpose2pcPlanar, TruthIsAmongTheCandidatesOfThousandScenes) {
  SceneGenerator scene(3);
  int recovered = 0;
  for (int i = 0; i < 1000; ++i) {
    const RelativePose T = scene.planar_motion();
    const auto acs = scattered(scene, T, 2);
    const auto found = relpose_2pc_planar(acs);
    recovered += nearest_pose(found, T) < kExact ? 1 : 0;
    for (const PlanarPose& pose : found) {
      const Eigen::Matrix3d E = essential_matrix(pose.pose());
      for (const auto& ac : acs) {
        EXPECT_NEAR(ac.x2.homogeneous().dot(E * ac.x1.homogeneous()), 0.0, 1e-12);
      }
    }
  }
  EXPECT_GE(recovered, 999);
}

TEST(Relpose1pcAckermann, RecoversForwardsAndBackwards) {
  SceneGenerator scene(4);
  for (int i = 0; i < 1000; ++i) {
    const RelativePose T = ackermann_motion(scene);
    const auto found = relpose_1pc_ackermann(scattered(scene, T, 1 + i % 3));
    ASSERT_EQ(found.size(), 1u) << "scene " << i << " of seed 4";
    EXPECT_LT(pose_error(found[0].pose(), T), kExact) << "scene " << i << " of seed 4";
  }
}

TEST(PlanarPointSolvers, BrokenInputAndPureRotationGiveNothing) {
  SceneGenerator scene(5);
  const RelativePose T = scene.planar_motion();
  const auto ground = on_one_plane(scene, T, scene.ground(), 2);
  expect_nothing_from_broken_points(ground, [](AcSpan s) { return relpose_2pc_ground(s); });
  const auto vertical = on_one_plane(scene, T, wall(scene), 3);
  expect_nothing_from_broken_points(vertical, [](AcSpan s) { return relpose_3pc_vertical(s); });
  const auto any = scattered(scene, T, 2);
  expect_nothing_from_broken_points(any, [](AcSpan s) { return relpose_2pc_planar(s); });
  const auto one = scattered(scene, ackermann_motion(scene), 1);
  expect_nothing_from_broken_points(one, [](AcSpan s) { return relpose_1pc_ackermann(s); });
  for (int i = 0; i < 300; ++i) {
    auto acs = turned(scene, 3);
    EXPECT_TRUE(relpose_2pc_planar(acs).empty()) << "case " << i << " of seed 5";
    EXPECT_TRUE(relpose_3pc_vertical(acs).empty()) << "case " << i << " of seed 5";
    for (auto& ac : acs) ac = pure_rotation(0.1, {ac.x1.x(), std::abs(ac.x1.y()) + 0.02});
    EXPECT_TRUE(relpose_2pc_ground(acs).empty()) << "case " << i << " of seed 5";
  }
}

TEST(PlanarPointSolvers, WeightZeroRemovesAnOutlier) {
  SceneGenerator scene(6);
  const RelativePose T = ackermann_motion(scene);
  const std::vector<double> weights{1.0, 0.0, 1.0, 1.0, 1.0};
  auto ground = on_one_plane(scene, T, scene.ground(), 5);
  ground[1].x2.x() += 0.2;
  EXPECT_LT(nearest_pose(relpose_2pc_ground(ground, weights.data()), T), kExact);
  auto vertical = on_one_plane(scene, T, wall(scene), 5);
  vertical[1].x2.x() += 0.2;
  EXPECT_LT(nearest_pose(relpose_3pc_vertical(vertical, weights.data()), T), kExact);
  auto any = scattered(scene, T, 5);
  any[1].x2.y() += 0.2;
  EXPECT_LT(nearest_pose(relpose_1pc_ackermann(any, weights.data()), T), kExact);
}

TEST(PlanarPointSolvers, DoNotAllocate) {
  SceneGenerator scene(7);
  const RelativePose T = ackermann_motion(scene);
  const auto ground = on_one_plane(scene, T, scene.ground(), 2);
  const auto vertical = on_one_plane(scene, T, wall(scene), 3);
  const std::size_t before = allocation_count();
  const auto a = relpose_2pc_ground(ground);
  const auto b = relpose_3pc_vertical(vertical);
  const auto c = relpose_2pc_planar(ground);
  const auto d = relpose_1pc_ackermann(ground);
  EXPECT_EQ(allocation_count(), before);
  EXPECT_FALSE(a.empty() || b.empty() || c.empty() || d.empty());
}

}  // namespace
}  // namespace oneac
