#include "oneac/comparison/summary.h"

#include "oneac/comparison/overlay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace oneac {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

PairRecord pair_with_truth(double step) {
  PairRecord pair;
  pair.acs = 100;
  pair.truth = RelativePose{Eigen::Matrix3d::Identity(), {0.0, 0.0, -step}};
  return pair;
}

MethodResult estimate(double rotation_deg, double direction_deg) {
  MethodResult result;
  result.status = "ok";
  result.has_pose = true;
  result.pose.R = pitch_rotation(rotation_deg * kDegree);
  const double angle = direction_deg * kDegree;
  result.pose.t << std::sin(angle), 0.0, -std::cos(angle);
  result.ms = 2.0;
  return result;
}

TEST(ErrorOf, MeasuresRotationAndDirection) {
  const ResultError error = error_of(pair_with_truth(1.0), estimate(0.5, 3.0));
  EXPECT_NEAR(*error.rotation / kDegree, 0.5, 1e-9);
  EXPECT_NEAR(*error.direction / kDegree, 3.0, 1e-9);
  EXPECT_NEAR(*error.pose / kDegree, 3.0, 1e-9);
  EXPECT_FALSE(error.failed);
}

TEST(ErrorOf, FailsBeyondOneDegreeOrFifteen) {
  EXPECT_TRUE(error_of(pair_with_truth(1.0), estimate(1.1, 0.0)).failed);
  EXPECT_TRUE(error_of(pair_with_truth(1.0), estimate(0.0, 16.0)).failed);
  EXPECT_TRUE(error_of(pair_with_truth(1.0), MethodResult{}).failed);
}

TEST(ErrorOf, JudgesNoDirectionOfASmallStep) {
  const ResultError error = error_of(pair_with_truth(0.05), estimate(0.5, 90.0));
  EXPECT_FALSE(error.direction);
  EXPECT_FALSE(error.failed);
  EXPECT_NEAR(*error.pose / kDegree, 0.5, 1e-9);
}

TEST(ErrorOf, IsEmptyWithoutAReference) {
  PairRecord pair = pair_with_truth(1.0);
  pair.truth.reset();
  const ResultError error = error_of(pair, estimate(0.5, 3.0));
  EXPECT_FALSE(error.rotation || error.direction || error.pose || error.failed);
}

TEST(AreaUnderRecall, IsOneForNoErrorAndZeroBeyondTheBound) {
  EXPECT_DOUBLE_EQ(*area_under_recall({0.0, 0.0}, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(*area_under_recall({2.0, std::numeric_limits<double>::infinity()}, 1.0), 0.0);
  EXPECT_DOUBLE_EQ(*area_under_recall({0.25, 0.75}, 1.0), 0.5);
  EXPECT_FALSE(area_under_recall({}, 1.0));
}

ComparisonData two_logs() {
  ComparisonData data;
  data.methods = {"a", "b"};
  for (std::size_t log = 0; log < 2; ++log) {
    LogRecord record;
    record.log = log;
    record.name = log == 0 ? "one" : "two";
    data.logs.push_back(record);
    PairRecord pair = pair_with_truth(1.0);
    pair.log = log;
    pair.results = {estimate(log == 0 ? 0.2 : 0.4, 1.0), estimate(2.0, 1.0)};
    pair.results[1].method = 1;
    data.pairs.push_back(pair);
  }
  return data;
}

TEST(Summarise, AveragesOverLogsAndAddsFailuresUp) {
  const auto rows = summarise(two_logs());
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_EQ(rows[4].log, "average");
  EXPECT_NEAR(*rows[4].rotation_mean_deg, 0.3, 1e-9);
  EXPECT_EQ(rows[4].failures, 0U);
  EXPECT_EQ(rows[5].failures, 2U);
  EXPECT_NEAR(*rows[5].ms_mean, 2.0, 1e-12);
}

TEST(Summarise, TakesNoIterationsForNotTold) {
  ComparisonData data = two_logs();
  EXPECT_FALSE(summarise(data)[0].iterations_mean);
  data.pairs[0].results[0].iterations = 7;
  EXPECT_EQ(summarise(data)[0].iterations_mean, 7.0);
}

TEST(WorstPairs, ComeWorstFirst) {
  const ComparisonData data = two_logs();
  EXPECT_EQ(worst_pairs(data, 0, 2), (std::vector<std::size_t>{1, 0}));
  EXPECT_EQ(worst_pairs(data, 0, 1), (std::vector<std::size_t>{1}));
}

TEST(ShownMethod, IsThePooledOneWhenItTakesPart) {
  ComparisonData data = two_logs();
  EXPECT_EQ(shown_method(data), 0U);
  data.methods[1] = "1ac_pooled";
  EXPECT_EQ(shown_method(data), 1U);
}

}  // namespace
}  // namespace oneac
