#pragma once

namespace oneac {

class Workers;

/// CPU time that the calling thread has used so far [ms]; the difference of two readings is a cost
/// that neither other threads nor other processes inflate.
[[nodiscard]] double thread_cpu_ms();

/// Adds the CPU time of its own lifetime to a counter [ms]: the calling thread's, and that of the
/// helpers it works with in the meantime, so that the figure does not depend on their number.
class StageTimer {
 public:
  explicit StageTimer(double& total_ms, const Workers* workers = nullptr);
  ~StageTimer();
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  [[nodiscard]] double now_ms() const;

  double& total_ms_;
  const Workers* workers_;
  double start_ms_;
};

}  // namespace oneac
