#include "read/name_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace oneac {
namespace {

std::string fault_of(const std::vector<std::string>& names) {
  NameOrder order;
  for (const std::string& name : names) order.add(name);
  return order.fault();
}

/// prefix1.jpg … prefixN.jpg
std::vector<std::string> numbered(const std::string& prefix, int count) {
  std::vector<std::string> names;
  for (int i = 1; i <= count; ++i) names.push_back(prefix + std::to_string(i) + ".jpg");
  return names;
}

TEST(NameOrder, FindsNamesThatWereSortedAsText) {
  for (const int count : {25, 120, 1500}) {
    auto names = numbered("frame", count);
    EXPECT_EQ(fault_of(names), "");
    std::sort(names.begin(), names.end());
    EXPECT_NE(fault_of(names), "") << count;
  }
  auto names = numbered("", 25);
  std::sort(names.begin(), names.end());
  EXPECT_NE(fault_of(names).find("first: 19.jpg, then 2.jpg"), std::string::npos)
      << fault_of(names);
}

TEST(NameOrder, ZerosInFrontDoNotCount) {
  EXPECT_EQ(fault_of({"008.png", "009.png", "010.png", "11.png", "000012.png"}), "");
}

TEST(NameOrder, ACounterMayBeginAnew) {
  auto names = numbered("a", 30);
  const auto again = numbered("a", 30);
  names.insert(names.end(), again.begin(), again.end());
  EXPECT_EQ(fault_of(names), "");
}

TEST(NameOrder, DecimalsAndNamesWithoutNumbersSayNothing) {
  std::vector<std::string> names;
  for (int i = 0; i < 50; ++i) {
    names.push_back("img_CAMERA1_12612287" + std::to_string(10 + i) + "." +
                    std::to_string(918590 - 7 * i) + "_left.jpg");
  }
  EXPECT_EQ(fault_of(names), "");
  EXPECT_EQ(fault_of({"c.png", "b.png", "a.png", ""}), "");
}

}  // namespace
}  // namespace oneac
