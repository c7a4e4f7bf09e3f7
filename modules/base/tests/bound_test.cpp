#include "oneac/base/bound.h"

#include "oneac/base/check_bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace oneac {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Sieve {
  double mesh = 0.5;
  int layers = 2;
  std::string metal = "tin";
};

template <class Visitor>
void describe(Visitor&& visit, Sieve& o) {
  visit("mesh", o.mesh, "mm", "width of a hole", Bound::positive());
  visit("layers", o.layers, "count", "one above the other", Bound::from_to(1, 3));
  visit("metal", o.metal, "name", "what it is made of", Bound::one_of("tin, zinc or gold"));
}

std::string complaint(const Sieve& sieve) {
  try {
    check_bounds("sieve", sieve);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Bound, HoldsItsEndsUnlessTheyAreOpen) {
  EXPECT_TRUE(Bound::from_to(-1, 4).holds(-1.0) && Bound::from_to(-1, 4).holds(4.0));
  EXPECT_FALSE(Bound::from_to(-1, 4).holds(4.5) || Bound::from_to(-1, 4).holds(-1.5));
  EXPECT_FALSE(Bound::between(0, 1).holds(0.0) || Bound::between(0, 1).holds(1.0));
  EXPECT_TRUE(Bound::above_to(0, 1).holds(1.0) && !Bound::above_to(0, 1).holds(0.0));
  EXPECT_TRUE(Bound::at_least(3).holds(3.0) && !Bound::at_least(3).holds(2.0));
  EXPECT_FALSE(Bound::positive().holds(0.0));
}

TEST(Bound, KeepsInfinityOutOnlyWhereItSaysSo) {
  EXPECT_TRUE(Bound::positive().holds(kInfinity));
  EXPECT_FALSE(Bound::positive_and_finite().holds(kInfinity));
}

TEST(Bound, HoldsNoNanUnlessAnythingMayBe) {
  const double nan = std::nan("");
  EXPECT_FALSE(Bound::positive().holds(nan) || Bound::at_least(0).holds(nan));
  EXPECT_FALSE(Bound::from_to(0, 1).holds(nan) || Bound::between(0, 1).holds(nan));
  EXPECT_TRUE(Bound().holds(nan));
}

TEST(Bound, HoldsEachNameOfItsListAndNoPartOfOne) {
  const Bound bound = Bound::one_of("fast, ceres or ceres+affine");
  EXPECT_TRUE(bound.holds("fast") && bound.holds("ceres") && bound.holds("ceres+affine"));
  EXPECT_FALSE(bound.holds("") || bound.holds("cer") || bound.holds("fast, ceres"));
  EXPECT_TRUE(Bound::one_of("uniform or prosac").holds("uniform"));
}

TEST(Bound, ReadsAsItStandsBehindMustBe) {
  EXPECT_EQ(Bound::positive().text(), "positive");
  EXPECT_EQ(Bound::positive_and_finite().text(), "positive and finite");
  EXPECT_EQ(Bound::at_least(0).text(), "at least 0");
  EXPECT_EQ(Bound::from_to(0, 1e6).text(), "from 0 to 1e+06");
  EXPECT_EQ(Bound::between(-45, 45).text(), "between -45 and 45");
  EXPECT_EQ(Bound::above_to(0, 1).text(), "above 0, at most 1");
  EXPECT_EQ(Bound::one_of("a or b").text(), "a or b");
  EXPECT_EQ(Bound().text(), "");
}

TEST(CheckBounds, NamesFieldValueAndBound) {
  EXPECT_EQ(complaint({}), "");
  EXPECT_EQ(complaint({-1.0, 2, "tin"}), "sieve.mesh = -1, must be positive");
  EXPECT_EQ(complaint({1.0, 4, "tin"}), "sieve.layers = 4, must be from 1 to 3");
  EXPECT_EQ(complaint({1.0, 1, "lead"}), "sieve.metal = lead, must be tin, zinc or gold");
}

}  // namespace
}  // namespace oneac
