#include "oneac/base/error.h"

#include <gtest/gtest.h>

namespace oneac {
namespace {

TEST(InputError, IsOneLineOfWhereFaultAndCure) {
  const InputError error("a.rawlog: record 3", "ends\nearly", "copy it again");
  EXPECT_STREQ(error.what(), "a.rawlog: record 3: ends early; copy it again");
}

TEST(InputError, IsShortAndHarmlessWhateverItQuotes) {
  const InputError error(std::string(100000, 'a'), "\x1b[2J" + std::string(100000, 'b'), "cure");
  EXPECT_LT(std::string(error.what()).size(), 2100U);
  EXPECT_EQ(std::string(error.what()).find('\x1b'), std::string::npos);
}

TEST(OutputError, LeavesOutAnEmptyCure) {
  EXPECT_STREQ(OutputError("a.txt", "disk full", "").what(), "a.txt: disk full");
}

}  // namespace
}  // namespace oneac
