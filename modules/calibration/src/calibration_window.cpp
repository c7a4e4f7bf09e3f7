#include "oneac/calibration/calibration_window.h"

#include "oneac/geometry/angular_errors.h"

#include <algorithm>
#include <utility>

namespace oneac {
namespace {

bool shares_a_track(const CalibrationView& a, const CalibrationView& b) {
  auto i = a.sightings.begin();
  auto j = b.sightings.begin();
  while (i != a.sightings.end() && j != b.sightings.end()) {
    if (i->track == j->track) return true;
    if (i->track < j->track) {
      ++i;
    } else {
      ++j;
    }
  }
  return false;
}

}  // namespace

double turn_of(const CalibrationWindow& window) {
  double turn = 0.0;
  for (const CalibrationView& view : window.views) {
    turn = std::max(turn, rotation_error(view.T_view_map.R, window.views.front().T_view_map.R));
  }
  return turn;
}

std::optional<CalibrationWindow> WindowCutter::add(CalibrationView view) {
  const bool goes_on = window_.views.empty() || (window_.views.size() < kViews &&
                                                 shares_a_track(window_.views.back(), view));
  std::optional<CalibrationWindow> before;
  if (!goes_on) before = finish();
  window_.views.push_back(std::move(view));
  return before;
}

CalibrationWindow WindowCutter::finish() {
  return std::exchange(window_, {});
}

}  // namespace oneac
