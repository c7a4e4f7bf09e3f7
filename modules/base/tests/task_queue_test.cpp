#include "oneac/base/task_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <thread>
#include <vector>

namespace oneac {
namespace {

TEST(TaskQueue, BeginsTasksInTheirOrder) {
  std::vector<int> begun;
  std::promise<void> done;
  TaskQueue queue(1);
  for (int i = 0; i < 100; ++i) {
    queue.add([&begun, &done, i] {
      begun.push_back(i);
      if (i == 99) done.set_value();
    });
  }
  done.get_future().wait();
  ASSERT_EQ(begun.size(), 100U);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(begun[static_cast<std::size_t>(i)], i);
}

TEST(TaskQueue, TakesAsManyTasksAtOnceAsItHasThreads) {
  constexpr int kThreads = 3;
  std::atomic<int> under_way{0};
  std::promise<void> all;
  const std::shared_future<void> together = all.get_future().share();
  std::vector<std::promise<void>> ends(kThreads);
  TaskQueue queue(kThreads);
  for (int i = 0; i < kThreads; ++i) {
    queue.add([&, i] {
      if (++under_way == kThreads) all.set_value();
      together.wait();  // for ever, were they not taken at once
      ends[static_cast<std::size_t>(i)].set_value();
    });
  }
  for (std::promise<void>& end : ends) end.get_future().wait();
  EXPECT_EQ(under_way, kThreads);
}

TEST(TaskQueue, FinishesWhatIsUnderWayAndDropsTheRestAtItsEnd) {
  constexpr int kRest = 1000;  // a second, were they not dropped
  const auto rest = [](int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); };
  std::promise<void> begun;
  bool is_finished = false;
  int others = 0;
  {
    TaskQueue queue(1);
    queue.add([&] {
      begun.set_value();
      rest(20);
      is_finished = true;
    });
    begun.get_future().wait();
    for (int i = 0; i < kRest; ++i) {
      queue.add([&] {
        rest(1);
        ++others;
      });
    }
  }
  EXPECT_TRUE(is_finished);
  EXPECT_LT(others, kRest);
}

}  // namespace
}  // namespace oneac
