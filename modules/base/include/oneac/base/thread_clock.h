#pragma once

namespace oneac {

/// CPU time that the calling thread has used so far [ms]; the difference of two readings is a cost
/// that neither other threads nor other processes inflate.
[[nodiscard]] double thread_cpu_ms();

/// Adds the CPU time of its own lifetime to a counter [ms].
class StageTimer {
 public:
  explicit StageTimer(double& total_ms) : total_ms_(total_ms), start_ms_(thread_cpu_ms()) {}
  ~StageTimer() { total_ms_ += thread_cpu_ms() - start_ms_; }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  double& total_ms_;
  double start_ms_;
};

}  // namespace oneac
