#include "standing.h"

#include <algorithm>
#include <cmath>

namespace oneac::internal {
namespace {

constexpr std::size_t kSample = 64;       // median of 64: known to a sixth of its spread
constexpr std::size_t kLeastTracks = 12;  // fewer say nothing about the whole image
constexpr double kRadius = 8.0;           // [px]
constexpr double kSameZncc = 0.8;
// Before a standing car three quarters of the picture stand; the rest may be traffic.
constexpr double kLeastShare = 0.75;
// Near road moves several times as far as the median point when the car creeps.
constexpr double kNearFactor = 3.0;

std::vector<double> shifts_of_sample(const std::vector<KltTrack>& tracks, const ImagePyramid& first,
                                     const ImagePyramid& second, std::size_t& asked) {
  static const PatchWindow window = padded_window(kRadius);
  const std::size_t step = std::max<std::size_t>(1, tracks.size() / kSample);
  std::vector<double> shifts;
  AnchoredPatch patch;
  for (std::size_t i = 0; i < tracks.size(); i += step) {
    if (!anchor_patch(first, 0, window, tracks[i].u, patch)) continue;
    ++asked;
    PatchWarp warp;
    warp.centre = tracks[i].u;
    AlignmentQuality quality;
    if (!align_shift(patch, second, warp, quality) || quality.zncc < kSameZncc) continue;
    shifts.push_back((warp.centre - tracks[i].u).norm());
  }
  return shifts;
}

}  // namespace

bool is_standing(const std::vector<KltTrack>& tracks, const ImagePyramid& first,
                 const ImagePyramid& second, double standing_px) {
  std::size_t asked = 0;
  std::vector<double> shifts = shifts_of_sample(tracks, first, second, asked);
  if (asked < kLeastTracks) return false;
  const auto needed = static_cast<std::size_t>(std::ceil(kLeastShare * static_cast<double>(asked)));
  if (shifts.size() < needed) return false;
  std::sort(shifts.begin(), shifts.end());
  return shifts[asked / 2] < standing_px && shifts[needed - 1] < kNearFactor * standing_px;
}

}  // namespace oneac::internal
