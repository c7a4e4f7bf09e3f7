#include "import/gps_order.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace oneac {
namespace {

using Fixes = std::vector<GpsRecord>;

constexpr double kPause_s = 60.0;  // behind it the receiver, or its clock, began anew
// A drive's own fixes are many, wrong dates come alone: a receiver corrects them within seconds.
constexpr std::size_t kFew = 5;
constexpr double kOtherDay_s = 12.0 * 3600.0;

bool is_nowhere(const GpsRecord& fix) {
  return fix.position.latitude_deg == 0.0 && fix.position.longitude_deg == 0.0;
}

bool goes_backwards(const Fixes& fixes) {
  std::ptrdiff_t balance = 0;
  for (std::size_t i = 1; i < fixes.size(); ++i) {
    const double step = fixes[i].time_s - fixes[i - 1].time_s;
    balance += step > 0.0 ? 1 : (step < 0.0 ? -1 : 0);
  }
  return balance < 0;
}

/// Fixes [begin, end) of a file without a pause, or a leap of its clock, between them.
struct Run {
  std::size_t begin, end;
  double first_s, last_s;

  [[nodiscard]] bool is_few() const { return end - begin < kFew; }
};

std::vector<Run> runs_of(const Fixes& fixes) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < fixes.size(); ++i) {
    const double time = fixes[i].time_s;
    if (runs.empty() || std::abs(time - runs.back().last_s) > kPause_s) {
      runs.push_back({i, i + 1, time, time});
    } else {
      runs.back().end = i + 1;
      runs.back().last_s = time;
    }
  }
  return runs;
}

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Per run, when the runs of many behind it begin.
std::vector<double> begins_behind(const std::vector<Run>& runs) {
  std::vector<double> begins(runs.size(), kNever);
  for (std::size_t i = runs.size(); i-- > 1;) {
    begins[i - 1] = runs[i].is_few() ? begins[i] : std::min(begins[i], runs[i].first_s);
  }
  return begins;
}

/// Whether the few fixes of a run do not fit between the end of the runs of many before it and the
/// begin of those behind.
bool is_misdated(const Run& run, double before_s, double behind_s) {
  if (!run.is_few() || (before_s == -kNever && behind_s == kNever)) return false;  // few anywhere
  const bool fits = before_s < run.first_s && run.last_s < behind_s;
  return !fits || std::min(run.first_s - before_s, behind_s - run.last_s) > kOtherDay_s;
}

void take_out_misdated(Fixes& fixes) {
  const std::vector<Run> runs = runs_of(fixes);
  const std::vector<double> behind = begins_behind(runs);
  double before = -kNever;
  Fixes kept;
  kept.reserve(fixes.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (is_misdated(runs[i], before, behind[i])) continue;
    if (!runs[i].is_few()) before = std::max(before, runs[i].last_s);
    const auto begin = fixes.begin();
    std::move(begin + static_cast<std::ptrdiff_t>(runs[i].begin),
              begin + static_cast<std::ptrdiff_t>(runs[i].end), std::back_inserter(kept));
  }
  fixes = std::move(kept);
}

/// Several tracks of one time are not mixed: the first stays.
void take_later_ones(Fixes& fixes) {
  Fixes later;
  later.reserve(fixes.size());
  for (GpsRecord& fix : fixes) {
    if (later.empty() || fix.time_s > later.back().time_s) later.push_back(std::move(fix));
  }
  fixes = std::move(later);
}

bool has_height(const GpsRecord& fix) {
  return std::isfinite(fix.position.altitude_m);
}

}  // namespace

double unknown_height() {
  return std::numeric_limits<double>::quiet_NaN();
}

std::size_t put_in_order(Fixes& fixes) {
  const std::size_t before = fixes.size();
  fixes.erase(std::remove_if(fixes.begin(), fixes.end(), is_nowhere), fixes.end());
  if (goes_backwards(fixes)) std::reverse(fixes.begin(), fixes.end());
  take_out_misdated(fixes);
  take_later_ones(fixes);
  return before - fixes.size();
}

void fill_heights(Fixes& fixes) {
  auto known = std::find_if(fixes.begin(), fixes.end(), has_height);
  if (known == fixes.end()) {
    for (GpsRecord& fix : fixes) fix.position.altitude_m = 0.0;
    return;
  }
  for (auto fix = fixes.begin(); fix != known; ++fix) {
    fix->position.altitude_m = known->position.altitude_m;
  }
  while (known != fixes.end()) {
    const auto next = std::find_if(known + 1, fixes.end(), has_height);
    const double from = known->position.altitude_m;
    const double rise = next == fixes.end() ? 0.0 : next->position.altitude_m - from;
    const double span = next == fixes.end() ? 1.0 : next->time_s - known->time_s;
    for (auto fix = known + 1; fix != next; ++fix) {
      const double share = span > 0.0 ? (fix->time_s - known->time_s) / span : 0.0;
      fix->position.altitude_m = from + rise * std::clamp(share, 0.0, 1.0);
    }
    known = next;
  }
}

}  // namespace oneac
