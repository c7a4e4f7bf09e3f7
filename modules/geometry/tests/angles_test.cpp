#include "oneac/geometry/angles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oneac {
namespace {

TEST(Angles, ConstantsAreTheNearestDoubles) {
  EXPECT_EQ(kPi, std::acos(-1.0));
  EXPECT_NEAR(std::sin(30.0 * kDegree), 0.5, 1e-15);
  EXPECT_DOUBLE_EQ(kPi / kDegree, 180.0);
}

}  // namespace
}  // namespace oneac
