#pragma once

#include <chrono>
#include <cstddef>

namespace oneac::app {

/// A line on stderr that shows how far a job is; silent in a pipe or when switched off.
class ProgressBar {
 public:
  explicit ProgressBar(bool wanted);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// @param share  0 … 1 of the whole job
  /// @param count  things done so far, shown with their rate
  void update(double share, std::size_t count);

 private:
  using Clock = std::chrono::steady_clock;
  bool active_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_{};
};

}  // namespace oneac::app
