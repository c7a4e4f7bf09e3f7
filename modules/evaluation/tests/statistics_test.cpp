#include "oneac/evaluation/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace oneac {
namespace {

TEST(Percentile, InterpolatesBetweenRanks) {
  // Ranks 0 … 3 of 1, 2, 4, 8: 50 % is rank 1.5, 95 % rank 2.85.
  EXPECT_DOUBLE_EQ(percentile({8, 1, 4, 2}, 50), 3.0);
  EXPECT_DOUBLE_EQ(percentile({8, 1, 4, 2}, 95), 4.0 + 0.85 * 4.0);
}

TEST(Percentile, EndsAtSmallestAndLargest) {
  EXPECT_EQ(percentile({3, 1, 2}, 0), 1.0);
  EXPECT_EQ(percentile({3, 1, 2}, 100), 3.0);
  EXPECT_EQ(percentile({7}, 95), 7.0);
}

TEST(Percentile, RefusesNoValuesAndForeignPercentages) {
  EXPECT_THROW((void)percentile({}, 50), std::invalid_argument);
  EXPECT_THROW((void)percentile({1}, 101), std::invalid_argument);
  EXPECT_THROW((void)percentile({1}, std::nan("")), std::invalid_argument);
}

TEST(StatisticsOf, AgreesWithHandComputedValues) {
  const auto s = statistics_of({1, 2, 3, 6});
  ASSERT_TRUE(s);
  EXPECT_EQ(s->count, 4U);
  EXPECT_DOUBLE_EQ(s->mean, 3.0);
  EXPECT_DOUBLE_EQ(s->median, 2.5);
  EXPECT_DOUBLE_EQ(s->p95, 3.0 + 0.85 * 3.0);
  EXPECT_DOUBLE_EQ(s->rmse, std::sqrt(50.0 / 4.0));
  EXPECT_DOUBLE_EQ(s->max, 6.0);
}

TEST(StatisticsOf, IsEmptyWithoutValues) {
  EXPECT_FALSE(statistics_of({}));
}

}  // namespace
}  // namespace oneac
