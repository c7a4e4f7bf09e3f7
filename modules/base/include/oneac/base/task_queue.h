#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace oneac {

/// Threads that take tasks in the order in which they were added.
///
/// At its end the tasks that nobody has begun are dropped, and those that are under way finished.
class TaskQueue {
 public:
  /// Must not throw.
  using Task = std::function<void()>;

  /// @param threads  at most, at least 1: one begins with each of the first tasks. Where the
  /// machine
  ///                 has no more, fewer do; where it has none, add() runs the task
  explicit TaskQueue(int threads);
  ~TaskQueue();
  TaskQueue(const TaskQueue&) = delete;
  TaskQueue& operator=(const TaskQueue&) = delete;

  /// From one thread.
  void add(Task task);

 private:
  void start_thread();
  void take();

  std::size_t most_;
  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::condition_variable added_;
  std::deque<Task> tasks_;
  bool ends_ = false;
};

}  // namespace oneac
