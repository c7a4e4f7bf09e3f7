#include "oneac/base/median.h"

#include <gtest/gtest.h>

namespace oneac {
namespace {

TEST(UpperMedian, IsTheMiddleValue) {
  EXPECT_EQ(upper_median({3.0, -1.0, 7.0}), 3.0);
  EXPECT_EQ(upper_median({5.0}), 5.0);
}

TEST(UpperMedian, IsTheUpperOfTwoMiddleValues) {
  EXPECT_EQ(upper_median({4.0, 1.0, 2.0, 3.0}), 3.0);
}

TEST(UpperMedian, RefusesNoValues) {
  EXPECT_THROW(static_cast<void>(upper_median({})), std::invalid_argument);
}

}  // namespace
}  // namespace oneac
