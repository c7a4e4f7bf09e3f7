#include "progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>

namespace oneac::app {
namespace {

constexpr int kWidth = 30;  // characters
constexpr auto kRedraw = std::chrono::milliseconds(100);

}  // namespace

ProgressBar::ProgressBar(bool wanted, std::string noun)
    : active_(wanted && ::isatty(STDERR_FILENO) == 1), noun_(std::move(noun)) {}

ProgressBar::~ProgressBar() {
  if (active_) std::fputs("\r\033[K", stderr);
}

void ProgressBar::update(double share, std::size_t count) {
  if (!active_ || Clock::now() - shown_ < kRedraw) return;
  shown_ = Clock::now();
  const double seconds = std::chrono::duration<double>(shown_ - start_).count();
  const double clamped = std::clamp(share, 0.0, 1.0);
  const int filled = static_cast<int>(clamped * kWidth);
  const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                          std::string(static_cast<std::size_t>(kWidth - filled), '.');
  std::fprintf(stderr, "\r[%s] %3.0f %%  %zu %s, %.1f/s\033[K", bar.c_str(), 100.0 * clamped, count,
               noun_.c_str(), seconds > 0.0 ? static_cast<double>(count) / seconds : 0.0);
  std::fflush(stderr);
}

}  // namespace oneac::app
