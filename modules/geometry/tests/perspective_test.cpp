#include "oneac/geometry/perspective.h"

#include "oneac/geometry/homography.h"
#include "oneac/geometry/triangulation.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>

namespace oneac {
namespace {

constexpr int kScenes = 1000;
constexpr double kExact = 1e-9;  // 1σ of affinities without noise

TEST(PerspectiveOf, TellsWhatTheAffinityOfAPlaneLeavesOut) {
  SceneGenerator scenes(71);
  for (int i = 0; i < kScenes; ++i) {
    const RelativePose T = scenes.general_motion();
    const Plane plane = scenes.any_plane();
    const AffineCorrespondence ac = scenes.on_plane(T, plane);
    const auto eta = perspective_of(ac, T, kExact);
    ASSERT_TRUE(eta.has_value()) << "scene " << i;
    const Eigen::Matrix3d H = plane_induced_homography(T, plane);
    const Eigen::Vector3d y = H * ac.x1.homogeneous();
    // ∂(log y_z)/∂x1
    const Eigen::Vector2d expected = H.row(2).head<2>().transpose() / y.z();
    EXPECT_LT((*eta - expected).norm(), 1e-5 * (1.0 + expected.norm())) << "scene " << i;
    const Eigen::Vector2d delta(0.004, -0.003);
    const Eigen::Vector2d moved = (H * (ac.x1 + delta).homogeneous()).hnormalized() - ac.x2;
    const Eigen::Vector2d affine = ac.A * delta;
    const Eigen::Vector2d bent = affine * (1.0 - eta->dot(delta));
    const double third_order = affine.norm() * std::pow(eta->dot(delta), 2);
    EXPECT_LE((moved - bent).norm(), 1.2 * third_order + 1e-9) << "scene " << i;
  }
}

TEST(PerspectiveOf, NeedsNoLengthOfTheMotion) {
  SceneGenerator scenes(72);
  for (int i = 0; i < 100; ++i) {
    RelativePose T = scenes.general_motion();
    const AffineCorrespondence ac = scenes.on_plane(T, scenes.any_plane());
    const auto eta = perspective_of(ac, T, 0.01);
    T.t *= 7.0;
    const auto same = perspective_of(ac, T, 0.01);
    ASSERT_TRUE(eta && same);
    EXPECT_LT((*eta - *same).norm(), 1e-9 * (1.0 + eta->norm()));
  }
}

TEST(PerspectiveOf, TakesAnUncertainPatchForOneThatFacesTheCamera) {
  SceneGenerator scenes(73);
  const RelativePose T = scenes.general_motion();
  const AffineCorrespondence ac = scenes.on_plane(T, scenes.any_plane());
  const auto eta = perspective_of(ac, T, 1e6);
  const auto point = triangulate(T, ac.x1, ac.x2);
  ASSERT_TRUE(eta && point);
  // g = 0: what is left is the turn of the camera.
  const double shrink = point->z2 / point->z1;
  const Eigen::Vector2d turned = T.R.row(2).head<2>().transpose() / shrink;
  EXPECT_LT((*eta - turned).norm(), 1e-6);
}

TEST(PerspectiveOf, IsSilentAboutPointsAtInfinityAndBehind) {
  const RelativePose forward{Eigen::Matrix3d::Identity(), {0.0, 0.0, -1.0}};
  AffineCorrespondence ac;
  ac.x1 = ac.x2 = {0.2, 0.1};
  EXPECT_FALSE(perspective_of(ac, forward, 0.01).has_value());
  ac.x2 = {0.15, 0.075};  // moves towards the vanishing point
  EXPECT_FALSE(perspective_of(ac, forward, 0.01).has_value());
}

}  // namespace
}  // namespace oneac
