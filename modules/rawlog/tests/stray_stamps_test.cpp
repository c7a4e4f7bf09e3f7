#include "import/bag/stray_stamps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace oneac {
namespace {

/// Ten images a second, recorded 30 ms after their stamps.
std::vector<MessageTime> drive(std::size_t images = 40) {
  std::vector<MessageTime> times;
  for (std::size_t i = 0; i < images; ++i) {
    const double stamp_s = 1000.0 + 0.1 * static_cast<double>(i);
    times.push_back({stamp_s, stamp_s + 0.03});
  }
  return times;
}

TEST(StrayStamps, AreThoseThatJumpForAnImage) {
  for (const std::size_t place : {0U, 1U, 20U, 38U, 39U}) {
    for (const double jump_s : {-100.0, 15.0, 1e5}) {
      auto times = drive();
      times[place].stamp_s += jump_s;
      const auto strays = stray_stamps(times);
      ASSERT_EQ(strays.size(), 1U) << place << " by " << jump_s;
      EXPECT_EQ(strays[0].place, place);
      EXPECT_NEAR(strays[0].off_s, jump_s, 1e-6);
    }
  }
}

TEST(StrayStamps, AreFoundSideBySide) {
  auto times = drive();
  times[20].stamp_s += 50.0;
  times[21].stamp_s -= 70.0;
  EXPECT_EQ(stray_stamps(times).size(), 2U);
}

TEST(StrayStamps, AreNoneOfMessagesInAnotherOrder) {
  auto times = drive();
  std::vector<double> stamps;
  for (const MessageTime& time : times) stamps.push_back(time.stamp_s);
  std::mt19937 random(1);
  std::shuffle(stamps.begin(), stamps.end(), random);
  for (std::size_t i = 0; i < times.size(); ++i) times[i].stamp_s = stamps[i];
  EXPECT_TRUE(stray_stamps(times).empty());
}

TEST(StrayStamps, AreNoneWhereAClockStepsOrDriftsOrCountsFromBoot) {
  for (const double step_s : {-60.0, 60.0}) {
    auto times = drive();
    for (std::size_t i = 20; i < times.size(); ++i) times[i].stamp_s += step_s;
    EXPECT_TRUE(stray_stamps(times).empty()) << step_s;
  }
  auto times = drive(2000);  // replayed at half the speed
  for (MessageTime& time : times) time.received_s = 5e8 + 2.0 * time.stamp_s;
  EXPECT_TRUE(stray_stamps(times).empty());
}

TEST(StrayStamps, AreNoneOfAnImageThatWasHeldUp) {
  auto times = drive();
  for (std::size_t i = 20; i < times.size(); ++i) {
    times[i].received_s += 30.0;  // one came as the recording went on
    if (i > 20) times[i].stamp_s += 30.0;
  }
  EXPECT_TRUE(stray_stamps(times).empty());
}

TEST(StrayStamps, OfTooFewMessagesAreNotTold) {
  auto times = drive(3);
  times[1].stamp_s += 100.0;
  EXPECT_TRUE(stray_stamps(times).empty());
  EXPECT_TRUE(stray_stamps({}).empty());
}

}  // namespace
}  // namespace oneac
