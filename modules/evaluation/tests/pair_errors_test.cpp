#include "oneac/evaluation/pair_errors.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oneac {
namespace {

constexpr double kDegree = 0.017453292519943295;

RelativePoseRow row_of(double yaw_deg, const Eigen::Vector3d& t, bool metric) {
  RelativePoseRow row;
  row.index1 = 3;
  row.index2 = 4;
  row.T_2_1 = {yaw_rotation(std::cos(yaw_deg * kDegree), std::sin(yaw_deg * kDegree)), t};
  row.metric = metric;
  return row;
}

const RelativePose kForward{Eigen::Matrix3d::Identity(), {0, 0, -2}};

Eigen::Vector3d aside(double degrees, double length) {
  return length * Eigen::Vector3d(std::sin(degrees * kDegree), 0, -std::cos(degrees * kDegree));
}

TEST(PairError, MeasuresRotationDirectionAndSignedLength) {
  const PairError error = pair_error(row_of(0.5, aside(3.0, 1.8), true), kForward);
  EXPECT_EQ(error.index1, 3U);
  EXPECT_EQ(error.index2, 4U);
  EXPECT_DOUBLE_EQ(error.true_step, 2.0);
  EXPECT_NEAR(error.rotation, 0.5 * kDegree, 1e-12);
  ASSERT_TRUE(error.direction);
  EXPECT_NEAR(*error.direction, 3.0 * kDegree, 1e-12);
  ASSERT_TRUE(error.length);
  EXPECT_NEAR(*error.length, -0.1, 1e-12);
}

TEST(PairError, SignOfTheDirectionCounts) {
  const PairError error = pair_error(row_of(0, {0, 0, 2}, true), kForward);
  EXPECT_NEAR(error.direction.value(), 180 * kDegree, 1e-12);
}

TEST(PairError, LengthIsJudgedOnlyWhereItIsMetric) {
  EXPECT_FALSE(pair_error(row_of(0, {0, 0, -1}, false), kForward).length);
  EXPECT_TRUE(pair_error(row_of(0, {0, 0, -1}, false), kForward).direction);
}

TEST(PairError, DirectionNeedsATrueStepOfMoreThanTenCentimetres) {
  const RelativePose standing{Eigen::Matrix3d::Identity(), {0, 0, -0.1}};
  const RelativePose creeping{Eigen::Matrix3d::Identity(), {0, 0, -0.101}};
  const auto row = row_of(2, {0, 0, 1}, true);
  EXPECT_FALSE(pair_error(row, standing).direction);
  EXPECT_FALSE(pair_error(row, standing).length);
  EXPECT_FALSE(pair_error(row, standing).is_bad());
  EXPECT_TRUE(pair_error(row, creeping).direction);
  EXPECT_TRUE(pair_error(row, creeping).is_bad());
}

TEST(PairError, AZeroTranslationHasNoDirection) {
  const PairError error = pair_error(row_of(0, Eigen::Vector3d::Zero(), true), kForward);
  EXPECT_TRUE(error.is_moving());
  EXPECT_FALSE(error.direction);
  EXPECT_FALSE(error.length);
}

TEST(PairError, IsBadBeyondOneDegreeOrFifteen) {
  EXPECT_FALSE(pair_error(row_of(0.99, aside(14.9, 1), false), kForward).is_bad());
  EXPECT_TRUE(pair_error(row_of(1.01, aside(0, 1), false), kForward).is_bad());
  EXPECT_TRUE(pair_error(row_of(0, aside(15.1, 1), false), kForward).is_bad());
}

TEST(SummarisePairs, CountsEachKindOfPair) {
  const RelativePose standing{Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()};
  const PairSummary summary =
      summarise({pair_error(row_of(0.2, aside(1, 1.8), true), kForward),
                 pair_error(row_of(0.4, aside(3, 2.6), true), kForward),
                 pair_error(row_of(2.0, aside(5, 1.0), false), kForward),
                 pair_error(row_of(0.2, Eigen::Vector3d::Zero(), false), kForward),
                 pair_error(row_of(0.2, {0, 0, 1}, false), standing)},
                7);
  EXPECT_EQ(summary.pairs, 5U);
  EXPECT_EQ(summary.without_reference, 7U);
  EXPECT_EQ(summary.moving, 4U);
  EXPECT_EQ(summary.metric, 2U);
  EXPECT_EQ(summary.bad, 1U);
  EXPECT_NEAR(summary.rotation->mean, 0.6 * kDegree, 1e-12);
  EXPECT_NEAR(summary.rotation->median, 0.2 * kDegree, 1e-12);
  EXPECT_EQ(summary.direction->count, 3U);
  EXPECT_NEAR(summary.direction->median, 3 * kDegree, 1e-12);
  EXPECT_NEAR(summary.length->mean, 0.2, 1e-12);  // of 0.1 short and 0.3 long
}

TEST(SummarisePairs, LeavesStatisticsOfNothingEmpty) {
  const PairSummary summary = summarise({}, 0);
  EXPECT_FALSE(summary.rotation);
  EXPECT_FALSE(summary.direction);
  EXPECT_FALSE(summary.length);
}

}  // namespace
}  // namespace oneac
