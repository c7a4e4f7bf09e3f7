#include "landmark_pose.h"

#include "loop_scenes.h"

#include "oneac/geometry/angular_errors.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace oneac::internal {
namespace {

constexpr double kNoise = 1e-3;
const RelativePose kTruth{yaw_rotation(std::cos(0.1), std::sin(0.1)), {1.5, 0.05, -2.0}};
const RelativePose kStart{Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()};

TEST(LandmarkPose, MeasuresAllSixDegreesOfFreedomInMetres) {
  std::mt19937 generator(1);
  const auto sights = test::landmark_sights(generator, 60, kTruth, 0.0, 0.0);
  LandmarkPose pose = pose_by_landmarks(sights, kStart, kNoise);
  ASSERT_TRUE(pose.usable);
  EXPECT_LT((pose.T_2_1.t - kTruth.t).norm(), 1e-6);
  EXPECT_LT((pose.T_2_1.R - kTruth.R).norm(), 1e-6);
  EXPECT_EQ(pose.first_side, 30U);
  EXPECT_EQ(pose.second_side, 30U);
}

TEST(LandmarkPose, LeavesOutWhatMoved) {
  std::mt19937 generator(2);
  auto sights = test::landmark_sights(generator, 80, kTruth, kNoise, 0.02);
  for (std::size_t i = 0; i < 24; ++i) sights[i].other += Eigen::Vector2d(0.08, -0.05);
  const LandmarkPose pose = pose_by_landmarks(sights, kStart, kNoise);
  ASSERT_TRUE(pose.usable);
  for (std::size_t i = 0; i < 24; ++i) EXPECT_FALSE(pose.inliers[i]) << i;
  EXPECT_LT((pose.T_2_1.t - kTruth.t).norm(), 0.1);
}

TEST(LandmarkPose, IsAsUncertainAsItsCovarianceSays) {
  constexpr int kScenes = 200;
  double squares = 0.0;
  int beyond = 0;
  for (int seed = 0; seed < kScenes; ++seed) {
    std::mt19937 generator(static_cast<unsigned>(seed));
    const auto sights = test::landmark_sights(generator, 60, kTruth, kNoise, 0.02);
    const LandmarkPose pose = pose_by_landmarks(sights, kStart, kNoise);
    ASSERT_TRUE(pose.usable) << seed;
    const Eigen::Vector3d e = pose.T_2_1.t - kTruth.t;
    const Eigen::Matrix3d covariance = pose.covariance.bottomRightCorner<3, 3>();
    const double squared = e.dot(covariance.ldlt().solve(e));
    squares += squared;
    if (squared > 8.02) ++beyond;  // 2σ of three degrees of freedom
  }
  // Twice the variance of independent sights is told, since both landmarks of a pair share errors.
  EXPECT_LT(squares / kScenes, 3.0);
  EXPECT_GT(squares / kScenes, 0.75);
  EXPECT_LT(beyond, kScenes / 10);
}

/// To one side of the image in one field of a chessboard of the first view, to the other in the
/// next.
double pushed(const LandmarkSight& sight) {
  const Eigen::Vector2d& x = sight.of_first ? sight.x : sight.other;
  return std::sin(10.0 * x.x()) * std::sin(10.0 * x.y()) > 0.0 ? 1.0 : -1.0;
}

TEST(LandmarkPose, IsLessSureOfWhatNeighboursShare) {
  std::mt19937 generator(5);
  auto together = test::landmark_sights(generator, 400, kTruth, kNoise, 0.0);
  auto alone = together;
  // The same errors, once shared by neighbours and once without an order.
  for (std::size_t i = 0; i < together.size(); ++i) {
    together[i].other.x() += 3.0 * kNoise * pushed(together[i]);
    alone[i].other.x() += i % 4 < 2 ? 3.0 * kNoise : -3.0 * kNoise;
  }
  const auto sigma_of = [](const std::vector<LandmarkSight>& sights) {
    const LandmarkPose pose = pose_by_landmarks(sights, kStart, kNoise);
    EXPECT_TRUE(pose.usable);
    return std::sqrt(pose.covariance.bottomRightCorner<3, 3>().trace());
  };
  EXPECT_GT(sigma_of(together), 1.5 * sigma_of(alone));
}

TEST(LandmarkPose, SaysNothingOutOfTooFew) {
  std::mt19937 generator(3);
  EXPECT_FALSE(pose_by_landmarks({}, kStart, kNoise).usable);
  const auto few = test::landmark_sights(generator, 4, kTruth, kNoise, 0.02);
  EXPECT_FALSE(pose_by_landmarks(few, kStart, kNoise).usable);
}

TEST(LandmarkPose, LengthIsThatOfTheLandmarks) {
  std::mt19937 generator(4);
  const auto sights = test::landmark_sights(generator, 80, kTruth, kNoise, 0.02);
  RelativePose unit = kTruth;
  unit.t.normalize();
  EXPECT_NEAR(length_by_landmarks(sights, unit), kTruth.t.norm(), 0.1);
  EXPECT_EQ(length_by_landmarks({}, unit), 0.0);
}

}  // namespace
}  // namespace oneac::internal
