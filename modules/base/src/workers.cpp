#include "oneac/base/workers.h"

#include "oneac/base/thread_clock.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace oneac {
namespace {

// Turns are taken so many times per thread: what one waits for another at the end is a sixteenth.
constexpr std::size_t kChunksPerThread = 16;

}  // namespace

Workers::Workers(int threads) {
  const auto helpers = static_cast<std::size_t>(std::clamp(threads, 1, kMost) - 1);
  helpers_.reserve(helpers);
  cpu_ms_.resize(helpers, 0.0);
  try {
    while (helpers_.size() < helpers) {
      helpers_.emplace_back([this, worker = helpers_.size() + 1] { help(worker); });
    }
  } catch (const std::system_error&) {
    return;  // no more threads to be had: results are the same
  }
}

Workers::~Workers() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  begun_.notify_all();
  for (std::thread& helper : helpers_) helper.join();
}

void Workers::share(std::size_t turns, const Turn& turn) {
  if (helpers_.empty() || turns < 2) {
    for (std::size_t i = 0; i < turns; ++i) turn(i, 0);
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    turn_ = &turn;
    turns_ = turns;
    chunk_ = std::max<std::size_t>(1, turns / (kChunksPerThread * count()));
    next_ = 0;
    is_open_ = true;
    ++loop_;
  }
  if (turns <= helpers_.size()) {
    for (std::size_t i = 1; i < turns; ++i) begun_.notify_one();
  } else {
    begun_.notify_all();
  }
  work(0);
  std::unique_lock lock(mutex_);
  is_open_ = false;  // who has not come by now need not
  left_.wait(lock, [this] { return busy_ == 0; });
  if (const auto fault = std::exchange(fault_, nullptr)) std::rethrow_exception(fault);
}

void Workers::help(std::size_t worker) {
  std::size_t last = 0;
  std::unique_lock lock(mutex_);
  for (;;) {
    begun_.wait(lock, [&] { return ends_ || (is_open_ && loop_ != last); });
    if (ends_) return;
    last = loop_;
    ++busy_;
    lock.unlock();
    work(worker);
    lock.lock();
    cpu_ms_[worker - 1] = thread_cpu_ms();
    if (--busy_ == 0) left_.notify_one();
  }
}

void Workers::work(std::size_t worker) {
  for (std::size_t first = 0; (first = next_.fetch_add(chunk_)) < turns_;) {
    const std::size_t last = std::min(first + chunk_, turns_);
    for (std::size_t i = first; i < last; ++i) {
      try {
        (*turn_)(i, worker);
      } catch (...) {
        note_fault(i);
        break;
      }
    }
  }
}

// Turns are handed out in their order: all before this one have been, and are taken to their end.
void Workers::note_fault(std::size_t index) {
  const std::lock_guard lock(mutex_);
  if (!fault_ || index < faulty_) {
    faulty_ = index;
    fault_ = std::current_exception();
  }
  next_ = turns_;
}

double Workers::helpers_cpu_ms() const {
  const std::lock_guard lock(mutex_);
  double sum = 0.0;
  for (const double helper : cpu_ms_) sum += helper;
  return sum;
}

}  // namespace oneac
