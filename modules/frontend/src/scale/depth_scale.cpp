#include "depth_scale.h"

#include "length_votes.h"

#include <cmath>

namespace oneac {
namespace {

// [-] of a depth by stereo: a tenth of a pixel of bad rectification at ten pixels of disparity,
// which no number of points averages out.
constexpr double kRectification = 0.01;

}  // namespace

std::optional<ScaleMeasurement> scale_by_depths(const std::vector<DepthComparison>& depths,
                                                std::size_t least) {
  std::vector<LengthVote> votes;
  for (const DepthComparison& depth : depths) {
    if (!(depth.measured.z > 0.0) || !(depth.in_map > 0.0)) continue;
    const double ratio = depth.measured.z / depth.in_map;
    votes.push_back({ratio, ratio * depth.measured.sigma, depth.in_map_sigma});
  }
  if (votes.empty() || votes.size() < least) return std::nullopt;
  const RobustMean mean = robust_mean(votes);
  if (mean.support < least) return std::nullopt;
  return ScaleMeasurement{mean.value, std::hypot(mean.relative_sigma, kRectification),
                          LengthSource::kStereo, mean.support};
}

}  // namespace oneac
