#include "standing.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

// The lowest quarter of the points is judged by itself: it is the nearest, and a rolling car under
// a far and cloudy sky shows nowhere else. It may creep by what a pair measures well, no farther.
constexpr double kLowFactor = 2.0;
constexpr std::size_t kLowest = 4;
constexpr std::size_t kLeastLow = 4;  // of them

constexpr double kLost = 1e9;

struct Look {
  double height = 0.0;  ///< [px] down the image
  double shift = 0.0;   ///< [px]; of what was lost or ran away: more than any bound
};

struct Sample {
  std::size_t asked = 0;
  std::vector<double> shifts;  ///< [px] of those that were found near where they were
  std::vector<Look> looks;     ///< all that were asked
};

std::size_t needed_of(std::size_t asked) {
  return static_cast<std::size_t>(std::ceil(kLeastShare * static_cast<double>(asked)));
}

/// Ends as soon as more moved than a standing picture allows: a driving car costs a quarter.
Sample look_where_they_were(const std::vector<KltTrack>& tracks, const ImagePyramid& first,
                            const ImagePyramid& second, double near_px) {
  static const PatchWindow window = padded_window(kRadius);
  const std::size_t step = std::max<std::size_t>(1, tracks.size() / kSample);
  const std::size_t planned = (tracks.size() + step - 1) / step;
  Sample sample;
  AnchoredPatch patch;
  for (std::size_t i = 0; i < tracks.size(); i += step) {
    if (!anchor_patch(first, 0, window, tracks[i].u, patch)) continue;
    ++sample.asked;
    PatchWarp warp;
    warp.centre = tracks[i].u;
    AlignmentQuality quality;
    const bool found = align_shift(patch, second, warp, quality) && quality.zncc >= kSameZncc;
    const double shift = (warp.centre - tracks[i].u).norm();
    const bool near = found && shift < near_px;
    if (near) sample.shifts.push_back(shift);
    sample.looks.push_back({tracks[i].u.y(), near ? shift : kLost});
    if (sample.asked - sample.shifts.size() > planned - needed_of(planned)) break;
  }
  return sample;
}

/// Whether the lowest points stand: their median has not crept beyond the bound.
bool lowest_stand(std::vector<Look> looks, double bound_px) {
  const std::size_t count = looks.size() / kLowest;
  if (count < kLeastLow) return true;
  const auto end = looks.begin() + static_cast<std::ptrdiff_t>(count);
  std::nth_element(looks.begin(), end, looks.end(),
                   [](const Look& a, const Look& b) { return a.height > b.height; });
  const auto middle = looks.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(looks.begin(), middle, end,
                   [](const Look& a, const Look& b) { return a.shift < b.shift; });
  return middle->shift < bound_px;
}

}  // namespace

bool is_standing(const std::vector<KltTrack>& tracks, const ImagePyramid& first,
                 const ImagePyramid& second, double standing_px) {
  Sample sample = look_where_they_were(tracks, first, second, kNearFactor * standing_px);
  if (sample.asked < kLeastTracks || sample.shifts.size() < needed_of(sample.asked)) return false;
  std::sort(sample.shifts.begin(), sample.shifts.end());
  return sample.shifts[sample.asked / 2] < standing_px &&
         lowest_stand(std::move(sample.looks), kLowFactor * standing_px);
}

}  // namespace oneac::internal
