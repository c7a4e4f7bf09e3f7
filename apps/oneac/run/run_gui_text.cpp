#include "run_gui_text.h"

#include "oneac/base/number_text.h"

#include <algorithm>

namespace oneac::app {
namespace {

// A standing step has zero metres without any scale.
bool travelled_in_metres(const FrameResult& frame) {
  return frame.step && frame.step->metric && frame.step->status == StepStatus::kOk;
}

std::string about(const StepResult& step) {
  if (step.status == StepStatus::kPredicted) return "last step: not seen, the motion goes on";
  if (step.repeats_image) return "last step: the image before, once more";
  if (step.status == StepStatus::kNoMotion) return "last step: standing";
  if (!step.metric) return "last step: not in metres";
  return "last step: in metres, 1 sigma " + fixed_text(100.0 * step.length_sigma, 1) + " %";
}

}  // namespace

std::vector<std::string> gui_lines(const FrameStore& frames) {
  if (frames.empty()) return {};
  const FrameResult last = frames.back();
  const double seconds = last.time_s - frames.front().time_s;
  const bool metres = std::any_of(frames.begin(), frames.end(), travelled_in_metres);
  std::vector<std::string> lines{
      "frame " + std::to_string(frames.size()) + ", " + fixed_text(seconds, 1) + " s",
      "distance " + fixed_text(way_along(frames), 1) + (metres ? " m" : " units, no metres yet")};
  if (last.step) lines.push_back(about(*last.step));
  return lines;
}

}  // namespace oneac::app
