#include "depth_scale.h"

#include "length_votes.h"

#include <cmath>

namespace oneac {
namespace {}  // namespace

std::optional<ScaleMeasurement> scale_by_depths(const std::vector<DepthComparison>& depths,
                                                std::size_t least) {
  std::vector<LengthVote> votes;
  double common = 0.0;
  for (const DepthComparison& depth : depths) {
    if (!(depth.measured.z > 0.0) || !(depth.in_map > 0.0)) continue;
    const double ratio = depth.measured.z / depth.in_map;
    common += depth.measured.sigma;  // by rectification, which does not average out
    votes.push_back({ratio, ratio * depth.measured.sigma, depth.in_map_sigma});
  }
  if (votes.empty() || votes.size() < least) return std::nullopt;
  const RobustMean mean = robust_mean(votes);
  if (mean.support < least) return std::nullopt;
  return ScaleMeasurement{
      mean.value, std::hypot(mean.relative_sigma, common / static_cast<double>(votes.size())),
      LengthSource::kStereo, mean.support};
}

}  // namespace oneac
