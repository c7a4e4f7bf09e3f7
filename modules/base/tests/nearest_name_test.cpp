#include "oneac/base/nearest_name.h"

#include <gtest/gtest.h>

namespace oneac {
namespace {

TEST(NearestName, FindsTheNameMeantByATypingError) {
  EXPECT_EQ(nearest_name("treshold_px", {"seed", "threshold_px", "modes"}), "threshold_px");
  EXPECT_EQ(nearest_name("sede", {"seed", "threads"}), "seed");
}

TEST(NearestName, IsEmptyWithoutCandidates) {
  EXPECT_EQ(nearest_name("a", {}), "");
}

}  // namespace
}  // namespace oneac
