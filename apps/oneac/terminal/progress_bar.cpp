#include "progress_bar.h"

#include "oneac/base/number_text.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

namespace oneac::app {
namespace {

constexpr std::size_t kWidest = 30, kNarrowest = 5;  // letters of the bar between its brackets
constexpr std::size_t kUsualColumns = 80;
constexpr auto kRedraw = std::chrono::milliseconds(100);

std::size_t columns_of_terminal() {
  winsize size{};
  const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : kUsualColumns;
}

/// "1:05", "2:03:04".
std::string clock_text(double seconds) {
  const auto whole = static_cast<long long>(std::min(std::ceil(seconds), 3.6e6));
  const auto two = [](long long value) {
    return std::string(value < 10 ? "0" : "") + std::to_string(value);
  };
  const std::string rest = two(whole % 60);
  if (whole < 3600) return std::to_string(whole / 60) + ":" + rest;
  return std::to_string(whole / 3600) + ":" + two(whole / 60 % 60) + ":" + rest;
}

std::string bar_text(double share, std::size_t width) {
  const auto filled = static_cast<std::size_t>(share * static_cast<double>(width));
  return "[" + std::string(filled, '#') + std::string(width - filled, '.') + "] ";
}

}  // namespace

std::string progress_text(const Progress& progress, const std::string& noun, std::size_t columns) {
  const auto& [done, total, share, seconds] = progress;
  std::string count = std::to_string(done);
  if (total > 0) count += " of " + std::to_string(total);
  std::vector<std::string> parts{count + " " + noun};
  const double rate = seconds > 0.0 ? static_cast<double>(done) / seconds : 0.0;
  if (rate > 0.0) parts.push_back(fixed_text(rate, 1) + "/s");
  if (rate > 0.0 && total > done) {
    parts.push_back(clock_text(static_cast<double>(total - done) / rate) + " left");
  }
  std::string text;
  for (const std::string& part : parts) {
    const std::string longer = text.empty() ? part : text + ", " + part;
    if (longer.size() > columns) break;
    text = longer;
  }
  if (text.empty()) text = count.substr(0, columns);
  const std::size_t room = columns - text.size();
  if (room < kNarrowest + 3) return text;
  return bar_text(std::clamp(share, 0.0, 1.0), std::min(kWidest, room - 3)) + text;
}

ProgressBar::ProgressBar(bool wanted, std::string noun)
    : active_(wanted && ::isatty(STDERR_FILENO) == 1), noun_(std::move(noun)) {}

ProgressBar::~ProgressBar() {
  if (active_) std::fputs("\r\033[K", stderr);
}

void ProgressBar::update(std::size_t count) {
  if (total_ > 0) show(static_cast<double>(count) / static_cast<double>(total_), count);
}

void ProgressBar::update(double share, std::size_t count) {
  show(share, count);
}

void ProgressBar::show(double share, std::size_t count) {
  if (!active_ || Clock::now() - shown_ < kRedraw) return;
  shown_ = Clock::now();
  const double seconds = std::chrono::duration<double>(shown_ - start_).count();
  // One column stays free: a terminal wraps when the last one is written.
  const std::size_t columns = std::max<std::size_t>(columns_of_terminal(), 2) - 1;
  const std::string text = progress_text({count, total_, share, seconds}, noun_, columns);
  std::fprintf(stderr, "\r%s\033[K", text.c_str());
  std::fflush(stderr);
}

}  // namespace oneac::app
