#include "run/run_gui_text.h"

#include <gtest/gtest.h>

namespace oneac::app {
namespace {

using Lines = std::vector<std::string>;

/// The next frame of a drive straight ahead, 1.25 m or units on and a tenth of a second later.
void drive_on(FrameStore& frames, bool metric, StepStatus status = StepStatus::kOk) {
  FrameResult frame;
  const auto i = static_cast<double>(frames.size());
  frame.time_s = 1.26e9 + 0.1 * i;
  frame.T_first_cam.translation().z() = 1.25 * i;
  if (!frames.empty()) {
    StepResult step;
    step.metric = metric;
    step.status = status;
    step.length_sigma = 0.0288;
    frame.step = step;
  }
  frames.push_back(frame);
}

TEST(GuiText, SaysFrameDistanceAndWhetherItIsInMetres) {
  FrameStore frames;
  EXPECT_EQ(gui_lines(frames), Lines{});
  drive_on(frames, true);
  EXPECT_EQ(gui_lines(frames), (Lines{"frame 1, 0.0 s", "distance 0.0 units, no metres yet"}));
  drive_on(frames, false);
  EXPECT_EQ(gui_lines(frames), (Lines{"frame 2, 0.1 s", "distance 1.2 units, no metres yet",
                                      "last step: not in metres"}));
  drive_on(frames, true);
  EXPECT_EQ(gui_lines(frames),
            (Lines{"frame 3, 0.2 s", "distance 2.5 m", "last step: in metres, 1 sigma 2.9 %"}));
}

TEST(GuiText, SaysThatTheCarStoodOrNothingWasSeen) {
  FrameStore frames;
  drive_on(frames, true);
  drive_on(frames, true, StepStatus::kNoMotion);
  EXPECT_EQ(gui_lines(frames)[1], "distance 1.2 units, no metres yet");
  EXPECT_EQ(gui_lines(frames)[2], "last step: standing");
  drive_on(frames, false, StepStatus::kPredicted);
  EXPECT_EQ(gui_lines(frames)[2], "last step: not seen, the motion goes on");
}

}  // namespace
}  // namespace oneac::app
