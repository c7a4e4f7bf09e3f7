#include "oneac/solvers/gravity.h"

#include "point_solver_tools.h"

#include "oneac/solvers/relpose_1ac_ground.h"
#include "oneac/solvers/relpose_1ac_planar.h"
#include "oneac/solvers/relpose_1ac_planar_pitch.h"
#include "oneac/solvers/relpose_1ac_wall.h"
#include "oneac/solvers/relpose_2pc_planar.h"
#include "oneac/test_support/allocation_counter.h"

#include <gtest/gtest.h>

namespace oneac {
namespace {

using namespace test;

/// Upright scenes seen by cameras with a tilt of their own.
struct Tilted {
  Eigen::Matrix3d Q1, Q2;  // tilted to upright
  RelativePose T;          // of the tilted cameras
  Eigen::Vector3d down1, down2;

  Tilted(SceneGenerator& scene, const RelativePose& upright) {
    Q1 = pitch_rotation(scene.uniform(-0.2, 0.2)) * roll_rotation(scene.uniform(-0.1, 0.1));
    Q2 = pitch_rotation(scene.uniform(-0.2, 0.2)) * roll_rotation(scene.uniform(-0.1, 0.1));
    T = {Q2.transpose() * upright.R * Q1, Q2.transpose() * upright.t};
    down1 = 9.81 * Q1.transpose() * Eigen::Vector3d::UnitY();
    down2 = Q2.transpose() * Eigen::Vector3d::UnitY();
  }
  [[nodiscard]] AffineCorrespondence see(const AffineCorrespondence& upright) const {
    return *rotate_views(upright, Q1.transpose(), Q2.transpose());
  }
};

TEST(Gravity, UprightRotationTakesDownToY) {
  SceneGenerator scene(1);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d down(scene.uniform(-1, 1), scene.uniform(-0.9, 1), scene.uniform(-1, 1));
    const auto Q = upright_rotation(down);
    ASSERT_TRUE(Q);
    EXPECT_LT((*Q * down.normalized() - Eigen::Vector3d::UnitY()).norm(), 1e-13);
    EXPECT_LT((*Q * Q->transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-13);
  }
  EXPECT_FALSE(upright_rotation(Eigen::Vector3d::Zero()));
  EXPECT_FALSE(upright_rotation(-Eigen::Vector3d::UnitY()));
  EXPECT_FALSE(upright_rotation(Eigen::Vector3d::Constant(std::nan(""))));
}

TEST(Gravity, SolversRecoverTheMotionOfTiltedCameras) {
  SceneGenerator scene(2);
  for (int i = 0; i < 300; ++i) {
    const RelativePose upright = scene.planar_motion();
    const Tilted tilted(scene, upright);
    const Plane ground = scene.ground();
    const AffineCorrespondence on_ground = tilted.see(on_one_plane(scene, upright, ground, 1)[0]);
    const auto found = solve_tilted(on_ground, tilted.down1, tilted.down2, relpose_1ac_ground);
    ASSERT_EQ(found.size(), 1u) << "scene " << i << " of seed 2";
    EXPECT_LT(pose_error(found[0].pose(), tilted.T), kExact) << "scene " << i << " of seed 2";
    EXPECT_LT((found[0].pose().t * ground.d - tilted.T.t).norm(), kExact);
    const AffineCorrespondence any = tilted.see(scattered(scene, upright, 1)[0]);
    EXPECT_LT(
        nearest_pose(solve_tilted(any, tilted.down1, tilted.down2, relpose_1ac_planar), tilted.T),
        kExact);
    const std::vector<AffineCorrespondence> two{any, tilted.see(scattered(scene, upright, 1)[0])};
    EXPECT_LT(nearest_pose(solve_tilted<2>(two, tilted.down1, tilted.down2, relpose_2pc_planar),
                           tilted.T),
              kExact);
    const Plane wall{Eigen::Vector3d(0.6, 0.0, 0.8), 8.0};
    const AffineCorrespondence on_wall = tilted.see(on_one_plane(scene, upright, wall, 1)[0]);
    EXPECT_LT(
        nearest_pose(solve_tilted(on_wall, tilted.down1, tilted.down2, relpose_1ac_wall), tilted.T),
        kExact);
    EXPECT_LT(nearest_pose(solve_tilted(any, tilted.down1, tilted.down2,
                                        [](const AffineCorrespondence& c) {
                                          return relpose_1ac_planar_pitch(c);
                                        }),
                           tilted.T),
              1e-4);
  }
}

TEST(Gravity, UnusableDirectionsGiveNothing) {
  SceneGenerator scene(3);
  const RelativePose T = scene.planar_motion();
  const AffineCorrespondence ac = on_one_plane(scene, T, scene.ground(), 1)[0];
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  EXPECT_EQ(solve_tilted(ac, y, y, relpose_1ac_ground).size(), 1u);
  EXPECT_TRUE(solve_tilted(ac, Eigen::Vector3d::Zero(), y, relpose_1ac_ground).empty());
  EXPECT_TRUE(solve_tilted(ac, y, -y, relpose_1ac_ground).empty());
  EXPECT_TRUE(
      solve_tilted(ac, y, Eigen::Vector3d::Constant(std::nan("")), relpose_1ac_ground).empty());
}

TEST(Gravity, DoesNotAllocate) {
  SceneGenerator scene(4);
  const RelativePose T = scene.planar_motion();
  const AffineCorrespondence ac = on_one_plane(scene, T, scene.ground(), 1)[0];
  const Eigen::Vector3d down(0.05, 1.0, -0.02);
  const std::size_t before = allocation_count();
  const auto found = solve_tilted(ac, down, down, relpose_1ac_ground);
  EXPECT_EQ(allocation_count(), before);
  EXPECT_EQ(found.size(), 1u);
}

}  // namespace
}  // namespace oneac
