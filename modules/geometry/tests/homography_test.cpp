#include "oneac/geometry/homography.h"

#include "oneac/geometry/angular_errors.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>
#include <limits>

namespace oneac {
namespace {

constexpr int kScenes = 1000;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Scene {
  RelativePose T;
  Plane plane;
  AffineCorrespondence ac;
};

Scene random_scene(SceneGenerator& scenes) {
  Scene scene{scenes.general_motion(), scenes.any_plane(), {}};
  scene.ac = scenes.on_plane(scene.T, scene.plane);
  return scene;
}

Eigen::Vector2d image_of(const Eigen::Vector3d& X) {
  return X.hnormalized();
}

void expect_same(const AffineCorrespondence& a, const AffineCorrespondence& b, double tolerance) {
  EXPECT_LT((a.x1 - b.x1).norm(), tolerance);
  EXPECT_LT((a.x2 - b.x2).norm(), tolerance);
  EXPECT_LT((a.A - b.A).norm(), tolerance);
}

TEST(Plane, OfTheGroundUnderACameraWithYDownHasItsHeightAsD) {
  const Plane ground{Eigen::Vector3d::UnitY(), 1.5};
  const Eigen::Vector3d on_road(0.5, 1.5, 6.0);
  EXPECT_DOUBLE_EQ(ground.n.dot(on_road), ground.d);
}

TEST(PlaneInducedHomography, FollowsAGroundPointWhenDrivingForward) {
  // One metre forward: a road point 6 m ahead comes to 5 m and sinks in the image.
  const RelativePose forward{Eigen::Matrix3d::Identity(), {0, 0, -1}};
  const Eigen::Matrix3d H = plane_induced_homography(forward, {Eigen::Vector3d::UnitY(), 1.5});
  const Eigen::Vector3d X1(0.6, 1.5, 6.0);
  EXPECT_TRUE(image_of(H * image_of(X1).homogeneous()).isApprox(Eigen::Vector2d(0.12, 0.3)));
}

TEST(PlaneInducedHomography, MapsPointsOfAnyPlane) {
  SceneGenerator scenes(10);
  for (int i = 0; i < kScenes; ++i) {
    const Scene s = random_scene(scenes);
    const double depth = s.plane.d / s.plane.n.dot(s.ac.x1.homogeneous());
    const Eigen::Vector2d x2 = image_of(s.T * (depth * s.ac.x1.homogeneous()));
    EXPECT_LT((x2 - s.ac.x2).norm(), 1e-9) << "seed 10, scene " << i;
  }
}

TEST(CorrespondenceFromHomography, HasTheDerivativeAsItsAffinity) {
  SceneGenerator scenes(11);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < kScenes; ++i) {
    const Scene s = random_scene(scenes);
    const Eigen::Matrix3d H = plane_induced_homography(s.T, s.plane);
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d dx = kStep * Eigen::Vector2d::Unit(axis);
      const Eigen::Vector2d slope = (image_of(H * (s.ac.x1 + dx).homogeneous()) -
                                     image_of(H * (s.ac.x1 - dx).homogeneous())) /
                                    (2.0 * kStep);
      EXPECT_LT((s.ac.A.col(axis) - slope).norm(), 1e-6) << "seed 11, scene " << i;
    }
  }
}

TEST(CorrespondenceFromHomography, IsEmptyBehindTheSecondCameraAndAtInfinity) {
  const Eigen::Matrix3d mirror = Eigen::Vector3d(1, 1, -1).asDiagonal();
  EXPECT_FALSE(correspondence_from_homography(mirror, {0.1, 0.2}));
  const Eigen::Matrix3d flat = Eigen::Vector3d(1, 1, 0).asDiagonal();
  EXPECT_FALSE(correspondence_from_homography(flat, {0.1, 0.2}));
}

TEST(CorrespondenceFromHomography, IsEmptyForNumbersThatAreNotFinite) {
  for (int entry = 0; entry < 9; ++entry) {
    Eigen::Matrix3d H = Eigen::Matrix3d::Identity();
    H(entry / 3, entry % 3) = kNaN;
    EXPECT_FALSE(correspondence_from_homography(H, {0.1, 0.2})) << entry;
  }
  EXPECT_FALSE(correspondence_from_homography(Eigen::Matrix3d::Identity(), {kNaN, 0.2}));
}

TEST(HomographyResidual, IsZeroForExactCorrespondencesWhateverTheScaleOfH) {
  SceneGenerator scenes(12);
  for (int i = 0; i < kScenes; ++i) {
    const Scene s = random_scene(scenes);
    const Eigen::Matrix3d H = -3.0 * plane_induced_homography(s.T, s.plane);
    EXPECT_LT(homography_residual(H, s.ac).norm(), 1e-12) << "seed 12, scene " << i;
  }
}

TEST(HomographyResidual, AreEquationsFourAndFiveInTheirOrder) {
  SceneGenerator scenes(13);
  const Eigen::Matrix3d H = Eigen::Matrix3d::NullaryExpr([&] { return scenes.uniform(-1, 1); });
  AffineCorrespondence ac{{0.1, -0.2}, {0.3, 0.25}, {}};
  ac.A << 1.2, 0.1, -0.3, 0.8;
  const double x = 0.1, y = -0.2, u = 0.3, v = 0.25, a1 = 1.2, a2 = 0.1, a3 = -0.3, a4 = 0.8;
  const double h1 = H(0, 0), h2 = H(0, 1), h3 = H(0, 2), h4 = H(1, 0), h5 = H(1, 1);
  const double h6 = H(1, 2), h7 = H(2, 0), h8 = H(2, 1), h9 = H(2, 2);
  Eigen::Matrix<double, 6, 1> expected;
  expected << h1 * x + h2 * y + h3 - u * (h7 * x + h8 * y + h9),  // eq. (4)
      h4 * x + h5 * y + h6 - v * (h7 * x + h8 * y + h9),
      h1 - (u + a1 * x) * h7 - a1 * y * h8 - a1 * h9,  // eq. (5)
      h2 - (u + a2 * y) * h8 - a2 * x * h7 - a2 * h9,
      h4 - (v + a3 * x) * h7 - a3 * y * h8 - a3 * h9,
      h5 - (v + a4 * y) * h8 - a4 * x * h7 - a4 * h9;
  EXPECT_LT((homography_residual(H, ac) - expected).norm(), 1e-14);
}

TEST(HomographyResidual, SeesAWrongAffinityAndAWrongPoint) {
  SceneGenerator scenes(14);
  const Scene s = random_scene(scenes);
  const Eigen::Matrix3d H = plane_induced_homography(s.T, s.plane);
  AffineCorrespondence wrong = s.ac;
  wrong.A(1, 0) += 0.1;
  EXPECT_GT(std::abs(homography_residual(H, wrong)(4)), 0.01);
  wrong = s.ac;
  wrong.x2.y() += 0.1;
  EXPECT_GT(std::abs(homography_residual(H, wrong)(1)), 0.01);
}

TEST(RotateViews, AgreesWithTheHomographyOfTheRotatedCameras) {
  SceneGenerator scenes(15);
  for (int i = 0; i < kScenes; ++i) {
    const Scene s = random_scene(scenes);
    const Eigen::Matrix3d Q1 = scenes.general_motion().R;
    const Eigen::Matrix3d Q2 = scenes.general_motion().R;
    // X1' = Q1 X1, X2' = Q2 X2: the motion becomes Q2 T Q1ᵀ, the normal Q1 n.
    const RelativePose T{Q2 * s.T.R * Q1.transpose(), Q2 * s.T.t};
    const Eigen::Matrix3d H = plane_induced_homography(T, {Q1 * s.plane.n, s.plane.d});
    const auto rotated = rotate_views(s.ac, Q1, Q2);
    ASSERT_TRUE(rotated) << "seed 15, scene " << i;
    const auto expected = correspondence_from_homography(H, image_of(Q1 * s.ac.x1.homogeneous()));
    expect_same(*rotated, *expected, 1e-9);
  }
}

TEST(RotateViews, IsUndoneByTheInverseRotations) {
  SceneGenerator scenes(16);
  const Scene s = random_scene(scenes);
  const Eigen::Matrix3d Q1 = scenes.general_motion().R;
  const Eigen::Matrix3d Q2 = scenes.general_motion().R;
  const auto there = rotate_views(s.ac, Q1, Q2);
  expect_same(*rotate_views(*there, Q1.transpose(), Q2.transpose()), s.ac, 1e-12);
}

TEST(RotateViews, IsEmptyWhenAPointTurnsBehindItsCamera) {
  const AffineCorrespondence ac;
  const Eigen::Matrix3d back = pitch_rotation(2.0);
  const Eigen::Matrix3d stay = Eigen::Matrix3d::Identity();
  EXPECT_TRUE(rotate_views(ac, stay, stay));
  EXPECT_FALSE(rotate_views(ac, back, stay));
  EXPECT_FALSE(rotate_views(ac, stay, back));
}

TEST(RotateViews, IsEmptyForNumbersThatAreNotFinite) {
  AffineCorrespondence ac;
  ac.A(0, 1) = kNaN;
  EXPECT_FALSE(rotate_views(ac, Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity()));
}

TEST(PlaneFromAffinity, RecoversNormalSignAndDistance) {
  SceneGenerator scenes(17);
  for (int i = 0; i < kScenes; ++i) {
    const Scene s = random_scene(scenes);
    const auto plane = plane_from_affinity(s.T, s.ac);
    ASSERT_TRUE(plane) << "seed 17, scene " << i;
    EXPECT_NEAR(plane->n.norm(), 1.0, 1e-12);
    EXPECT_LT(direction_error(plane->n, s.plane.n), 1e-6) << "seed 17, scene " << i;
    EXPECT_NEAR(plane->d / s.plane.d, 1.0, 1e-6) << "seed 17, scene " << i;
  }
}

TEST(PlaneFromAffinity, RecoversTheGroundInCameraHeights) {
  SceneGenerator scenes(18);
  for (int i = 0; i < kScenes; ++i) {
    const RelativePose T = scenes.planar_motion();
    const Plane ground = scenes.ground();
    const auto plane = plane_from_affinity(T, scenes.on_plane(T, ground));
    ASSERT_TRUE(plane) << "seed 18, scene " << i;
    EXPECT_LT((plane->d * plane->n - ground.d * ground.n).norm(), 1e-6) << "seed 18, scene " << i;
  }
}

TEST(PlaneFromAffinity, TurnsItsNormalAwayFromTheCameraForAPointBehindIt) {
  // Flipping t puts the point behind the cameras: n·x1 > 0 stays, d turns negative.
  SceneGenerator scenes(19);
  const Scene s = random_scene(scenes);
  const auto plane = plane_from_affinity({s.T.R, -s.T.t}, s.ac);
  ASSERT_TRUE(plane);
  EXPECT_GT(plane->n.dot(s.ac.x1.homogeneous()), 0.0);
  EXPECT_NEAR(plane->d / s.plane.d, -1.0, 1e-6);
}

TEST(PlaneFromAffinity, IsEmptyWithoutTranslation) {
  EXPECT_FALSE(plane_from_affinity(RelativePose(), {{0.1, 0.2}, {0.1, 0.2}, {}}));
}

TEST(PlaneFromAffinity, IsEmptyInTheFocusOfExpansionWhereTheSlantCannotBeSeen) {
  const RelativePose forward{Eigen::Matrix3d::Identity(), {0, 0, -1}};
  const Eigen::Matrix2d grows = 1.25 * Eigen::Matrix2d::Identity();  // a wall 5 m ahead, or a slope
  EXPECT_FALSE(plane_from_affinity(forward, {{0, 0}, {0, 0}, grows}));
}

TEST(PlaneFromAffinity, IsEmptyForNumbersThatAreNotFinite) {
  const RelativePose forward{Eigen::Matrix3d::Identity(), {0, 0, -1}};
  AffineCorrespondence ac{{0.1, 0.2}, {0.12, 0.24}, Eigen::Matrix2d::Identity()};
  ac.A(0, 0) = kNaN;
  EXPECT_FALSE(plane_from_affinity(forward, ac));
}

TEST(AffineCorrespondence, SwappedMapsBackwards) {
  SceneGenerator scenes(20);
  const Scene s = random_scene(scenes);
  const Eigen::Matrix3d H = plane_induced_homography(s.T, s.plane);
  const auto backwards = correspondence_from_homography(H.inverse(), s.ac.x2);
  ASSERT_TRUE(backwards);
  expect_same(swapped(s.ac), *backwards, 1e-9);
  expect_same(swapped(swapped(s.ac)), s.ac, 1e-12);
}

TEST(AffineCorrespondence, KnowsWhetherItIsFinite) {
  AffineCorrespondence ac;
  EXPECT_TRUE(ac.is_finite());
  ac.x2.y() = kNaN;
  EXPECT_FALSE(ac.is_finite());
  ac = {};
  ac.A(1, 1) = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(ac.is_finite());
}

}  // namespace
}  // namespace oneac
