#include "oneac/base/workers.h"

#include "oneac/base/thread_clock.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace oneac {
namespace {

/// Burns CPU time, so that nobody can do all turns before the others are awake.
double spin(double ms) {
  const double start = thread_cpu_ms();
  while (thread_cpu_ms() - start < ms) continue;
  return ms;
}

TEST(Workers, TakeEveryTurnOnceAtAnyThreadCount) {
  for (const int threads : {-1, 0, 1, 2, 3, 8, 64}) {
    Workers workers(threads);
    for (const std::size_t turns : {0U, 1U, 2U, 7U, 1000U}) {
      std::vector<int> taken(turns, 0);
      workers.share(turns, [&](std::size_t i, std::size_t) { ++taken[i]; });
      EXPECT_EQ(taken, std::vector<int>(turns, 1)) << threads << " threads";
    }
  }
}

TEST(Workers, NumberThemselvesBelowTheirCountAndTwoAtWorkDiffer) {
  Workers workers(4);
  ASSERT_EQ(workers.count(), 4U);
  std::vector<std::atomic<int>> at_work(workers.count());
  std::atomic<bool> shared{false};
  workers.share(500, [&](std::size_t, std::size_t worker) {
    ASSERT_LT(worker, at_work.size());
    if (at_work[worker].fetch_add(1) != 0) shared = true;
    std::this_thread::sleep_for(std::chrono::microseconds(20));
    at_work[worker].fetch_sub(1);
  });
  EXPECT_FALSE(shared);
}

TEST(Workers, WorkOnTheCallersThreadAloneWhenThereAreNoOthers) {
  Workers workers;
  const auto caller = std::this_thread::get_id();
  workers.share(50, [&](std::size_t, std::size_t worker) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    EXPECT_EQ(worker, 0U);
  });
  EXPECT_EQ(workers.helpers_cpu_ms(), 0.0);
}

TEST(Workers, ShareTheWork) {
  Workers workers(2);
  std::atomic<int> by_helper{0};
  workers.share(200, [&](std::size_t, std::size_t worker) {
    std::this_thread::sleep_for(std::chrono::microseconds(200));
    by_helper += worker == 1 ? 1 : 0;
  });
  EXPECT_GT(by_helper, 0);
}

// The exception that a plain loop would have thrown, whoever throws first.
TEST(Workers, HandTheExceptionOfTheFirstFaultyTurnToTheCaller) {
  for (const int threads : {1, 2, 4, 8}) {
    Workers workers(threads);
    for (int repeat = 0; repeat < 20; ++repeat) {
      std::vector<std::atomic<int>> taken(300);
      try {
        workers.share(300, [&](std::size_t i, std::size_t) {
          ++taken[i];
          if (i == 120) std::this_thread::sleep_for(std::chrono::microseconds(300));
          if (i >= 120) throw std::runtime_error("turn " + std::to_string(i));
        });
        ADD_FAILURE() << "no exception";
      } catch (const std::runtime_error& error) {
        EXPECT_EQ(error.what(), std::string("turn 120")) << threads << " threads";
      }
      for (std::size_t i = 0; i < 120; ++i) EXPECT_EQ(taken[i], 1) << "before the fault";
    }
  }
}

TEST(Workers, GoOnAfterAnException) {
  Workers workers(3);
  const auto faulty = [](std::size_t, std::size_t) { throw std::runtime_error("turn"); };
  EXPECT_THROW(workers.share(10, faulty), std::runtime_error);
  std::atomic<int> taken{0};
  workers.share(10, [&](std::size_t, std::size_t) { ++taken; });
  EXPECT_EQ(taken, 10);
}

TEST(Workers, CpuTimeOfHelpersCountsInAStage) {
  Workers workers(4);
  double stage_ms = 0.0, caller_ms = 0.0;
  {
    const StageTimer stage(stage_ms, &workers);
    const StageTimer caller(caller_ms);
    workers.share(40, [](std::size_t, std::size_t) {
      static_cast<void>(spin(1.0));
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    });
  }
  EXPECT_GE(stage_ms, 40.0);
  EXPECT_LT(caller_ms, 40.0);
  EXPECT_NEAR(stage_ms, caller_ms + workers.helpers_cpu_ms(), 0.5);
}

}  // namespace
}  // namespace oneac
