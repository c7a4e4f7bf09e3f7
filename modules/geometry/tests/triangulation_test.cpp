#include "oneac/geometry/triangulation.h"

#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <limits>

namespace oneac {
namespace {

constexpr int kScenes = 1000;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const RelativePose kSideways{Eigen::Matrix3d::Identity(), {-1, 0, 0}};  // camera moves right

struct PointPair {
  RelativePose T;
  Eigen::Vector3d X1;
  Eigen::Vector2d x1, x2;
};

/// A point in front of both cameras of a random motion.
PointPair random_pair(SceneGenerator& scenes) {
  PointPair pair;
  do {
    pair.T = scenes.general_motion();
    pair.x1 = scenes.image_point();
    pair.X1 = scenes.uniform(3.0, 30.0) * pair.x1.homogeneous();
  } while ((pair.T * pair.X1).z() < 0.5);
  pair.x2 = (pair.T * pair.X1).hnormalized();
  return pair;
}

TEST(Triangulate, RecoversExactPointsAndDepths) {
  SceneGenerator scenes(27);
  for (int i = 0; i < kScenes; ++i) {
    const PointPair pair = random_pair(scenes);
    const auto point = triangulate(pair.T, pair.x1, pair.x2);
    ASSERT_TRUE(point) << "seed 27, scene " << i;
    const double parallax = pair.T.t.cross(pair.T * pair.X1).norm() / (pair.T * pair.X1).norm();
    const double tolerance = 1e-12 * pair.X1.squaredNorm() / parallax;
    EXPECT_LT((point->X1 - pair.X1).norm(), tolerance) << "seed 27, scene " << i;
    EXPECT_NEAR(point->z1, pair.X1.z(), tolerance) << "seed 27, scene " << i;
    EXPECT_NEAR(point->z2, (pair.T * pair.X1).z(), tolerance) << "seed 27, scene " << i;
    EXPECT_TRUE(point->in_front()) << "seed 27, scene " << i;
  }
}

TEST(Triangulate, ReturnsTheMiddleOfRaysThatMiss) {
  // Rays of two cameras 1 m apart that pass 0.2 m above and below the point 10 m ahead.
  const auto point = triangulate(kSideways, {0.05, 0.02}, {-0.05, -0.02});
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->X1.x(), 0.5, 1e-3);
  EXPECT_NEAR(point->X1.y(), 0.0, 1e-12);
  EXPECT_NEAR(point->z1, point->z2, 1e-12);
}

TEST(Triangulate, KeepsNegativeDepths) {
  const Eigen::Vector3d behind(0.5, 0.2, -10.0);
  const auto point =
      triangulate(kSideways, behind.hnormalized(), (kSideways * behind).hnormalized());
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->z1, -10.0, 1e-9);
  EXPECT_NEAR(point->z2, -10.0, 1e-9);
  EXPECT_LT((point->X1 - behind).norm(), 1e-9);
  EXPECT_FALSE(point->in_front());
}

TEST(TriangulatedPoint, IsInFrontOnlyWithBothDepthsPositive) {
  const Eigen::Vector3d X = Eigen::Vector3d::Zero();
  EXPECT_TRUE((TriangulatedPoint{X, 1, 1}.in_front()));
  EXPECT_FALSE((TriangulatedPoint{X, 1, -1}.in_front()));
  EXPECT_FALSE((TriangulatedPoint{X, -1, 1}.in_front()));
}

TEST(Triangulate, IsEmptyForParallelRays) {
  EXPECT_FALSE(triangulate(kSideways, {0.1, 0.2}, {0.1, 0.2}));
  EXPECT_FALSE(triangulate(RelativePose(), {0.1, 0.2}, {0.1, 0.2}));
}

TEST(Triangulate, IsEmptyBelowTheAskedParallax) {
  const Eigen::Vector2d x1(0, 0), x2(-0.01, 0);  // 0.01 rad
  EXPECT_TRUE(triangulate(kSideways, x1, x2, 0.009));
  EXPECT_FALSE(triangulate(kSideways, x1, x2, 0.011));
}

TEST(Triangulate, IsEmptyForNumbersThatAreNotFinite) {
  EXPECT_FALSE(triangulate(kSideways, {kNaN, 0}, {0, 0}));
  EXPECT_FALSE(triangulate(kSideways, {0.1, 0}, {0, kNaN}));
  EXPECT_FALSE(triangulate({Eigen::Matrix3d::Identity(), {kNaN, 0, 0}}, {0.1, 0}, {0, 0}));
}

TEST(Cheirality, IsPositiveForTheTrueMotionAndFlipsWithT) {
  SceneGenerator scenes(28);
  for (int i = 0; i < kScenes; ++i) {
    const PointPair pair = random_pair(scenes);
    EXPECT_EQ(cheirality(pair.T, pair.x1, pair.x2), 1) << "seed 28, scene " << i;
    const RelativePose flipped{pair.T.R, -pair.T.t};
    EXPECT_EQ(cheirality(flipped, pair.x1, pair.x2), -1) << "seed 28, scene " << i;
  }
}

TEST(Cheirality, IsZeroForPointsBetweenTheCamerasAndForParallelRays) {
  // The second camera stands 4 m ahead, the point 2 m: in front of the first only.
  const RelativePose ahead{Eigen::Matrix3d::Identity(), {0, 0, -4}};
  const Eigen::Vector3d X1(0.5, 0, 2);
  EXPECT_EQ(cheirality(ahead, X1.hnormalized(), (ahead * X1).hnormalized()), 0);
  EXPECT_EQ(cheirality(kSideways, {0.1, 0.2}, {0.1, 0.2}), 0);
  EXPECT_EQ(cheirality(kSideways, {kNaN, 0.2}, {0.1, 0.2}), 0);
}

}  // namespace
}  // namespace oneac
