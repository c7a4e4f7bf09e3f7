#include "oneac/base/require.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace oneac {
namespace {

template <class Value>
std::string message_of(const Value& value) {
  try {
    require(false, "study.trials", value, "1 … 9");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Require, NamesFieldValueAndBound) {
  EXPECT_EQ(message_of(12), "study.trials = 12, must be 1 … 9");
  EXPECT_EQ(message_of(0.25), "study.trials = 0.25, must be 1 … 9");
  EXPECT_EQ(message_of(9.0000001), "study.trials = 9.0000001, must be 1 … 9");
  EXPECT_EQ(message_of(std::string("many")), "study.trials = many, must be 1 … 9");
  EXPECT_EQ(message_of(1234567), "study.trials = 1234567, must be 1 … 9");  // no grouping
  EXPECT_EQ(message_of(std::numeric_limits<double>::quiet_NaN()),
            "study.trials = nan, must be 1 … 9");
}

TEST(Require, LetsPassWhatIsMet) {
  EXPECT_NO_THROW(require(true, "study.trials", 3, "1 … 9"));
}

}  // namespace
}  // namespace oneac
