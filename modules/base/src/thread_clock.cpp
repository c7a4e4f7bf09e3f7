#include "oneac/base/thread_clock.h"

#include "oneac/base/workers.h"

#include <ctime>

namespace oneac {

double thread_cpu_ms() {
  timespec now{};
  if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) != 0) return 0.0;
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

StageTimer::StageTimer(double& total_ms, const Workers* workers)
    : total_ms_(total_ms), workers_(workers), start_ms_(now_ms()) {}

StageTimer::~StageTimer() {
  total_ms_ += now_ms() - start_ms_;
}

double StageTimer::now_ms() const {
  return thread_cpu_ms() + (workers_ != nullptr ? workers_->helpers_cpu_ms() : 0.0);
}

}  // namespace oneac
