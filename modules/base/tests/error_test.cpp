#include "oneac/base/error.h"

#include <gtest/gtest.h>

namespace oneac {
namespace {

TEST(InputError, IsOneLineOfWhereFaultAndCure) {
  const InputError error("a.rawlog: record 3", "ends\nearly", "copy it again");
  EXPECT_STREQ(error.what(), "a.rawlog: record 3: ends early; copy it again");
}

TEST(OutputError, LeavesOutAnEmptyCure) {
  EXPECT_STREQ(OutputError("a.txt", "disk full", "").what(), "a.txt: disk full");
}

}  // namespace
}  // namespace oneac
