#include "oneac/calibration/calibration_window.h"

#include "oneac/test_support/synthetic_bend.h"

#include <gtest/gtest.h>

namespace oneac {
namespace {

CalibrationView view_of(std::vector<std::uint64_t> tracks) {
  CalibrationView view;
  for (const std::uint64_t track : tracks) view.sightings.push_back({track, {0.0, 0.0}});
  return view;
}

TEST(CalibrationWindow, ADriveIsCutWhereItsViewsAreEnoughAndWhereTracksEnd) {
  WindowCutter cutter;
  for (std::uint64_t i = 0; i < WindowCutter::kViews; ++i) {
    EXPECT_FALSE(cutter.add(view_of({i, i + 1})));
  }
  const auto full = cutter.add(view_of({WindowCutter::kViews, 99}));
  ASSERT_TRUE(full);
  EXPECT_EQ(full->views.size(), WindowCutter::kViews);
  EXPECT_FALSE(cutter.add(view_of({99, 100})));
  const auto broken = cutter.add(view_of({200}));
  ASSERT_TRUE(broken);
  EXPECT_EQ(broken->views.size(), 2U);
  EXPECT_EQ(cutter.finish().views.size(), 1U);
  EXPECT_TRUE(cutter.finish().views.empty());
}

TEST(CalibrationWindow, ItsTurnIsTheLargestAngleFromTheFirstView) {
  SyntheticDrive drive;
  drive.turn = 0.02;
  drive.nod = 0.0;
  EXPECT_NEAR(turn_of(synthetic_window(drive, true_camera())), 0.22, 1e-9);
}

}  // namespace
}  // namespace oneac
