#include "stereo_depths.h"

#include "oneac/features/image_mask.h"
#include "oneac/features/stereo_matching.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace oneac {
namespace {

// Points of a frame that are looked for: the near ones are few, and all of them count.
constexpr std::size_t kMost = 1000;
// [px] a smaller disparity is a depth to 5 % and worse.
constexpr double kLeastDisparity = 3.0;
// [px] 1σ of a disparity by what rectification leaves, alike for neighbours: in the rectified
// images of published drives depths at the picture's border are wrong by half a pixel.
constexpr double kRectification = 0.3;

}  // namespace

TrackedPair with_stereo_depths(TrackedPair pair, const CameraFrame& frame) {
  if (frame.right.empty() || !(frame.baseline_m > 0.0)) return pair;
  const std::size_t stride = std::max<std::size_t>(1, (pair.size() + kMost - 1) / kMost);
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < pair.size(); i += stride)
    points.push_back(pair.correspondences[i].x2);
  const auto found = match_along_rows(frame.image.view(), frame.right.view(), points);
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (!found[k] || found[k]->px < kLeastDisparity) continue;
    const Eigen::Vector2d right(points[k].x() - found[k]->px, points[k].y());
    if (!usable_in(frame.right_mask, right)) continue;
    pair.correspondences[k * stride].depth =
        MeasuredDepth{frame.camera.fx * frame.baseline_m / found[k]->px,
                      std::hypot(found[k]->sigma_px, kRectification) / found[k]->px};
  }
  return pair;
}

}  // namespace oneac
