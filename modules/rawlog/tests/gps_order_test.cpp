#include "import/gps_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace oneac {
namespace {

constexpr double kStart = 1714557600.0;
constexpr double kWeeks1024 = 1024.0 * 7.0 * 86400.0;

GpsRecord fix_at(double time_s, double altitude_m = 100.0) {
  GpsRecord fix;
  fix.time_s = time_s;
  fix.position = {48.1, 11.5, altitude_m};
  return fix;
}

/// One a second.
std::vector<GpsRecord> track(int count, double begin_s = kStart) {
  std::vector<GpsRecord> fixes;
  for (int i = 0; i < count; ++i) fixes.push_back(fix_at(begin_s + i));
  return fixes;
}

TEST(GpsOrder, OneWrongDateCostsOneFix) {
  for (const double off : {-kWeeks1024, 56.0 * 365.25 * 86400.0, -86400.0, 3600.0, -3600.0}) {
    for (const std::size_t at : {std::size_t{0}, std::size_t{7}, std::size_t{15}}) {
      // An hour off at the end where it may be a pause.
      const bool may_be = std::abs(off) < 4000.0 && ((at == 0) == (off < 0.0)) && at != 7;
      if (may_be) continue;
      auto fixes = track(16);
      fixes[at].time_s += off;
      EXPECT_EQ(put_in_order(fixes), 1U) << off << " at " << at;
      ASSERT_EQ(fixes.size(), 15U) << off << " at " << at;
      EXPECT_NEAR(fixes.front().time_s, kStart, 1.5);
      EXPECT_NEAR(fixes.back().time_s, kStart + 15.0, 1.5);
    }
  }
}

TEST(GpsOrder, AFileThatGoesBackwardsIsTurnedAboutWithItsWrongDate) {
  auto fixes = track(16);
  std::reverse(fixes.begin(), fixes.end());
  fixes.front().time_s -= kWeeks1024;
  EXPECT_EQ(put_in_order(fixes), 1U);
  EXPECT_EQ(fixes.size(), 15U);
  EXPECT_EQ(fixes.front().time_s, kStart);
}

TEST(GpsOrder, PausesAndDaysOfDrivingStay) {
  auto fixes = track(20);
  for (const double later : {300.0, 86400.0, 10.0 * 86400.0}) {
    for (const GpsRecord& fix : track(20, kStart + later)) fixes.push_back(fix);
  }
  EXPECT_EQ(put_in_order(fixes), 0U);
  std::vector<GpsRecord> seldom;  // a logger with a fix in two minutes
  for (int i = 0; i < 10; ++i) seldom.push_back(fix_at(kStart + 120.0 * i));
  EXPECT_EQ(put_in_order(seldom), 0U);
  auto tunnels = track(20);
  tunnels.push_back(fix_at(kStart + 200.0));
  for (const GpsRecord& fix : track(20, kStart + 400.0)) tunnels.push_back(fix);
  EXPECT_EQ(put_in_order(tunnels), 0U);
}

TEST(GpsOrder, TwoTracksOfOneTimeAreNotMixed) {
  auto fixes = track(20);
  for (GpsRecord fix : track(20, kStart + 0.5)) {
    fix.position.latitude_deg += 1.0;
    fixes.push_back(fix);
  }
  EXPECT_EQ(put_in_order(fixes), 19U);
  EXPECT_EQ(fixes[18].position.latitude_deg, 48.1);
}

TEST(GpsOrder, AHeightThatIsNotToldIsThatOfTheFixesAround) {
  auto fixes = track(7);
  for (GpsRecord& fix : fixes) fix.position.altitude_m = unknown_height();
  auto none = fixes;
  fill_heights(none);
  EXPECT_EQ(none[3].position.altitude_m, 0.0);
  fixes[1].position.altitude_m = 600.0;
  fixes[5].position.altitude_m = 604.0;
  fill_heights(fixes);
  const double expected[] = {600.0, 600.0, 601.0, 602.0, 603.0, 604.0, 604.0};
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(fixes[i].position.altitude_m, expected[i]) << i;
  std::vector<GpsRecord> nothing;
  fill_heights(nothing);
  EXPECT_EQ(put_in_order(nothing), 0U);
}

}  // namespace
}  // namespace oneac
