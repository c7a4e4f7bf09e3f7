#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace oneac::app {

/// How far a job is.
struct Progress {
  std::size_t done = 0;   ///< things
  std::size_t total = 0;  ///< of them in the whole job; 0: not known
  double share = 0.0;     ///< 0 … 1 of the job
  double seconds = 0.0;   ///< since it began
};

/// The text of a progress bar, at most `columns` letters of ASCII: things of things, rate, time
/// left; what does not fit is left out from the end, the bar itself first.
[[nodiscard]] std::string progress_text(const Progress& progress, const std::string& noun,
                                        std::size_t columns);

/// A line on stderr that shows how far a job is; silent in a pipe or when switched off.
class ProgressBar {
 public:
  /// @param noun  what is counted
  explicit ProgressBar(bool wanted, std::string noun = "frames");
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  [[nodiscard]] bool is_shown() const { return active_; }
  /// How many things the whole job has.
  void expect(std::size_t total) { total_ = total; }
  /// @param count  things done so far, of those expected
  void update(std::size_t count);
  /// For a job whose things are not counted before. @param share  0 … 1 of the whole job
  void update(double share, std::size_t count);

 private:
  void show(double share, std::size_t count);

  using Clock = std::chrono::steady_clock;
  bool active_;
  std::string noun_;
  std::size_t total_ = 0;
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_{};
};

}  // namespace oneac::app
