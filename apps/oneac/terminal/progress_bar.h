#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace oneac::app {

/// A line on stderr that shows how far a job is; silent in a pipe or when switched off.
class ProgressBar {
 public:
  /// @param noun  what is counted
  explicit ProgressBar(bool wanted, std::string noun = "frames");
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// @param share  0 … 1 of the whole job
  /// @param count  things done so far, shown with their rate
  void update(double share, std::size_t count);

 private:
  using Clock = std::chrono::steady_clock;
  bool active_;
  std::string noun_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_{};
};

}  // namespace oneac::app
