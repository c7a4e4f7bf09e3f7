#include "oneac/base/finite_number.h"

#include <gtest/gtest.h>

namespace oneac {
namespace {

TEST(FiniteNumber, IsAWholeTextOrNone) {
  EXPECT_EQ(finite_number("-2.5e3"), -2500.0);
  EXPECT_EQ(finite_number("0"), 0.0);
  EXPECT_EQ(finite_number("+1.5"), 1.5);
  EXPECT_EQ(finite_number("010"), 10.0);
  for (const char* text :
       {"", " 1", "1 ", "1,5", "+", "+-1", "++1", "nan", "inf", "1e999", "0x10", "one"}) {
    EXPECT_FALSE(finite_number(text).has_value()) << text;
  }
}

}  // namespace
}  // namespace oneac
