#include "oneac/base/task_queue.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace oneac {

TaskQueue::TaskQueue(int threads) : most_(static_cast<std::size_t>(std::max(threads, 1))) {}

TaskQueue::~TaskQueue() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  added_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void TaskQueue::start_thread() {
  try {
    threads_.emplace_back([this] { take(); });
  } catch (const std::system_error&) {
    most_ = threads_.size();  // no more threads to be had: results are the same
  }
}

void TaskQueue::add(Task task) {
  if (threads_.size() < most_) start_thread();
  if (threads_.empty()) {
    task();
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
  }
  added_.notify_one();
}

void TaskQueue::take() {
  std::unique_lock lock(mutex_);
  for (;;) {
    added_.wait(lock, [this] { return ends_ || !tasks_.empty(); });
    if (ends_) return;
    const Task task = std::move(tasks_.front());
    tasks_.pop_front();
    lock.unlock();
    task();
    lock.lock();
  }
}

}  // namespace oneac
