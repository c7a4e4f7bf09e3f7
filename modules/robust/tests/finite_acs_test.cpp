#include "oneac/robust/finite_acs.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace oneac {
namespace {

std::vector<AffineCorrespondence> three() {
  std::vector<AffineCorrespondence> acs(3);
  for (std::size_t i = 0; i < acs.size(); ++i) acs[i].x1.x() = static_cast<double>(i);
  return acs;
}

TEST(FiniteAcs, CopiesNothingWhereAllAreFinite) {
  const auto acs = three();
  const FiniteAcs finite(acs);
  EXPECT_EQ(finite.acs().begin(), acs.data());
  EXPECT_EQ(finite.acs().size(), 3U);
  EXPECT_EQ(finite.spread({true, false, true}), (std::vector<bool>{true, false, true}));
}

TEST(FiniteAcs, PutsFlagsBackBesideThoseThatTookNoPart) {
  auto acs = three();
  acs[1].A(1, 0) = std::numeric_limits<double>::quiet_NaN();
  const FiniteAcs finite(acs);
  ASSERT_EQ(finite.acs().size(), 2U);
  EXPECT_EQ(finite.acs()[1].x1.x(), 2.0);
  EXPECT_EQ(finite.spread({true, true}), (std::vector<bool>{true, false, true}));
}

}  // namespace
}  // namespace oneac
