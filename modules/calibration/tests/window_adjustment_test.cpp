#include "window_adjustment.h"

#include "oneac/test_support/synthetic_bend.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace oneac {
namespace {

constexpr double kSigma_px = 0.3;
constexpr std::size_t kMiddle = 5;

CalibrationWindow bend() {
  SyntheticDrive drive;
  drive.turn = 0.03;
  return synthetic_window(drive, true_camera());
}

/// Tracks of at least five views that kMiddle is neither the first nor the last of, as `change`
/// makes their sighting there.
template <typename Change>
CalibrationWindow changed_in_the_middle(CalibrationWindow window, Change&& change) {
  const auto sees = [&](std::size_t view, std::uint64_t track) {
    for (const CalibrationSighting& s : window.views[view].sightings) {
      if (s.track == track) return true;
    }
    return false;
  };
  std::vector<CalibrationSighting> kept;
  for (CalibrationSighting s : window.views[kMiddle].sightings) {
    const bool inside = sees(kMiddle - 2, s.track) && sees(kMiddle - 1, s.track) &&
                        sees(kMiddle + 1, s.track) && sees(kMiddle + 2, s.track);
    if (!inside || change(s)) kept.push_back(s);
  }
  window.views[kMiddle].sightings = kept;
  return window;
}

IntrinsicsMatrix information_of(const CalibrationWindow& window) {
  return WindowAdjustment(window, true_camera(), IntrinsicsVector::Zero(), {})
      .information(kSigma_px);
}

TEST(WindowAdjustment, AnOutlierIsNoInformation) {
  const CalibrationWindow without =
      changed_in_the_middle(bend(), [](const CalibrationSighting&) { return false; });
  const CalibrationWindow wrong = changed_in_the_middle(bend(), [](CalibrationSighting& s) {
    s.u.x() += 20.0;
    return true;
  });
  const IntrinsicsMatrix expected = information_of(without);
  EXPECT_LT((information_of(wrong) - expected).norm(), 1e-9 * expected.norm());
  EXPECT_GT((information_of(bend()) - expected).norm(), 1e-2 * expected.norm());
}

}  // namespace
}  // namespace oneac
