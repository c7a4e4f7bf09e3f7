#include "oneac/base/number_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

namespace oneac {
namespace {

TEST(NumberText, ReadsBackAsTheSameNumber) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> digits(-1.0, 1.0);
  std::uniform_int_distribution<int> exponent(-300, 300);
  for (int i = 0; i < 1000; ++i) {
    const double value = std::ldexp(digits(random), exponent(random));
    EXPECT_EQ(std::stod(exact_text(value)), value);
    EXPECT_EQ(std::stod(exact_fixed_text(value, 6)), value);
  }
  EXPECT_EQ(exact_text(0.1), "0.1");
  EXPECT_EQ(exact_text(0.1F), "0.1");
  EXPECT_EQ(exact_text(std::numeric_limits<double>::max()), "1.7976931348623157e+308");
}

TEST(NumberText, KeepsAtLeastTheDecimalsAskedFor) {
  EXPECT_EQ(exact_fixed_text(1e9, 6), "1000000000.000000");
  EXPECT_EQ(exact_fixed_text(0.5, 2), "0.50");
  EXPECT_EQ(exact_fixed_text(0.0625, 2), "0.0625");
}

TEST(NumberText, RoundsToTheDigitsAskedFor) {
  EXPECT_EQ(fixed_text(2.5, 0), "2");  // to even
  EXPECT_EQ(fixed_text(1234.5678, 2), "1234.57");
  EXPECT_EQ(significant_text(1234.5678, 6), "1234.57");
  EXPECT_EQ(significant_text(1e-9, 3), "1e-09");
  EXPECT_EQ(three_digits(0.012345), "0.0123");
  EXPECT_EQ(three_digits(-123456.0), "-123456");
}

TEST(NumberText, HasNoMinusZero) {
  for (const std::string& text :
       {exact_text(-0.0), fixed_text(-0.0, 0), significant_text(-0.0, 3), three_digits(-0.0)}) {
    EXPECT_EQ(text, "0");
  }
  EXPECT_EQ(fixed_text(-0.001, 2), "0.00");
}

TEST(NumberText, HoldsTheLongestNumbers) {
  EXPECT_EQ(fixed_text(std::numeric_limits<double>::max(), 9).size(), 309U + 10U);
  EXPECT_EQ(
      std::strtod(exact_fixed_text(std::numeric_limits<double>::denorm_min(), 0).c_str(), nullptr),
      std::numeric_limits<double>::denorm_min());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::string& text : {exact_text(nan), exact_fixed_text(nan, 2), fixed_text(nan, 2),
                                  significant_text(nan, 2), three_digits(nan)}) {
    EXPECT_EQ(text, "nan");
  }
}

}  // namespace
}  // namespace oneac
