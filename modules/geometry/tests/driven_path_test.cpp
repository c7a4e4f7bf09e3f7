#include "oneac/geometry/driven_path.h"

#include "oneac/geometry/angles.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace oneac {
namespace {

const Eigen::Matrix3d kLevel = Eigen::Matrix3d::Identity();

/// A step along a circle of this radius to the right, by an arc of this length.
RelativePose on_circle(double radius, double arc) {
  const double turn = arc / radius;
  const Eigen::Vector3d place(radius * (1.0 - std::cos(turn)), 0.0, radius * std::sin(turn));
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitY()).toRotationMatrix().transpose();
  return {R, -R * place};
}

TEST(DrivenPath, OfAStraightStepStaysOnTheAxis) {
  const DrivenPath path({kLevel, {0.0, 0.0, -1.0}}, kLevel);
  EXPECT_DOUBLE_EQ(path.at(10.0).value(), 0.0);
}

TEST(DrivenPath, FollowsTheCircleOfABendToEitherSide) {
  for (const double radius : {9.0, -9.0, 30.0}) {
    const DrivenPath path(on_circle(radius, 0.5), kLevel);
    const double turn = 6.0 / std::abs(radius);
    const double z = std::abs(radius) * std::sin(turn);
    EXPECT_NEAR(path.at(z).value(), radius * (1.0 - std::cos(turn)), 0.01) << radius;
  }
}

TEST(DrivenPath, EndsWhereTheBendHasTurnedOff) {
  const DrivenPath path(on_circle(9.0, 0.5), kLevel);
  EXPECT_TRUE(path.at(8.5).has_value());
  EXPECT_FALSE(path.at(9.5).has_value());
}

TEST(DrivenPath, OfACarThatBacksIsTheWayItCame) {
  const RelativePose forward = on_circle(20.0, 0.5);
  const DrivenPath path(forward.inverse(), kLevel);
  EXPECT_NEAR(path.at(6.0).value(), DrivenPath(forward, kLevel).at(6.0).value(), 0.01);
}

TEST(DrivenPath, LeavesOutTheTiltOfTheCamera) {
  const Eigen::Matrix3d tilt =
      Eigen::AngleAxisd(8.0 * kDegree, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const RelativePose level = on_circle(20.0, 0.5);
  const RelativePose tilted{tilt * level.R * tilt.transpose(), tilt * level.t};
  const DrivenPath path(tilted, tilt.transpose());
  EXPECT_NEAR(path.at(6.0).value(), DrivenPath(level, kLevel).at(6.0).value(), 1e-9);
}

TEST(DrivenPath, IsStraightForACameraThatLooksAside) {
  const DrivenPath path({on_circle(9.0, 0.5).R, {-1.0, 0.0, 0.0}}, kLevel);
  EXPECT_DOUBLE_EQ(path.at(20.0).value(), 0.0);
}

TEST(DrivenPath, IsStraightWithoutAStep) {
  EXPECT_DOUBLE_EQ(DrivenPath(RelativePose{}, kLevel).at(5.0).value(), 0.0);
}

}  // namespace
}  // namespace oneac
