#include "oneac/base/ordered_pipeline.h"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

namespace oneac {
namespace {

std::vector<int> squares_of_first(int count, int threads, int stop_after = 1000) {
  int given = 0;
  std::vector<int> out;
  ordered_pipeline(
      [&]() -> std::optional<int> {
        if (given == count) return std::nullopt;
        return given++;
      },
      [](int i) {
        std::this_thread::sleep_for(std::chrono::microseconds((i % 3) * 200));  // out of step
        return i * i;
      },
      [&](int square) {
        out.push_back(square);
        return static_cast<int>(out.size()) < stop_after;
      },
      threads);
  return out;
}

TEST(OrderedPipeline, GivesTheSameSequenceAtAnyThreadCount) {
  const std::vector<int> one = squares_of_first(40, 1);
  EXPECT_EQ(one.size(), 40U);
  EXPECT_EQ(squares_of_first(40, 2), one);
  EXPECT_EQ(squares_of_first(40, 7), one);
}

TEST(OrderedPipeline, StopsWhenTheConsumerHasEnough) {
  EXPECT_EQ(squares_of_first(40, 3, 5).size(), 5U);
}

TEST(OrderedPipeline, HandsAWorkersExceptionToTheCaller) {
  int given = 0;
  const auto next = [&]() -> std::optional<int> {
    return given < 4 ? std::optional(given++) : std::nullopt;
  };
  const auto map = [](int i) -> int {
    if (i == 2) throw std::runtime_error("bad item");
    return i;
  };
  EXPECT_THROW(ordered_pipeline(
                   next, map, [](int) { return true; }, 2),
               std::runtime_error);
}

// What the threads had prepared before a fault is not lost, at any number of them.
TEST(OrderedPipeline, ConsumesEverythingBeforeAFaultAtAnyThreadCount) {
  constexpr int kGood = 11;
  for (const bool fault_is_in_map : {false, true}) {
    for (const int threads : {1, 2, 4, 8, 16}) {
      int given = 0, consumed = 0;
      const auto next = [&]() -> std::optional<int> {
        if (!fault_is_in_map && given == kGood) throw std::runtime_error("bad record");
        return given++;
      };
      const auto map = [&](int i) {
        if (fault_is_in_map && i == kGood) throw std::runtime_error("bad image");
        return i;
      };
      const auto consume = [&](int i) {
        EXPECT_EQ(i, consumed++);
        return true;
      };
      EXPECT_THROW(ordered_pipeline(next, map, consume, threads), std::runtime_error);
      EXPECT_EQ(consumed, kGood) << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace oneac
