#include "stereo_depths.h"

#include "oneac/features/stereo_matching.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace oneac {
namespace {

// Depths of a frame: their scatter falls below that of the calibration long before.
constexpr std::size_t kMost = 200;
// [px] a smaller disparity is a depth to 5 % and worse.
constexpr double kLeastDisparity = 3.0;

}  // namespace

void add_stereo_depths(const CameraFrame& frame, const TrackedPair& pair, StepTracks& step) {
  if (frame.right.empty() || !(frame.baseline_m > 0.0)) return;
  const std::size_t stride = std::max<std::size_t>(1, (pair.acs.size() + kMost - 1) / kMost);
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < pair.acs.size(); i += stride) points.push_back(pair.acs[i].x2);
  const auto found = match_along_rows(frame.image.view(), frame.right.view(), points);
  step.depths.assign(pair.acs.size(), {});
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (!found[k] || found[k]->px < kLeastDisparity) continue;
    step.depths[k * stride] = {frame.camera.fx * frame.baseline_m / found[k]->px,
                               found[k]->sigma_px / found[k]->px};
  }
}

}  // namespace oneac
