#pragma once

#include "consensus/pose_search.h"

#include "oneac/robust/point_set.h"
#include "oneac/robust/robust_result.h"

#include <vector>

namespace oneac::internal {

/// The correspondences in every form that the stages need.
struct ConsensusProblem {
  AcSpan acs;
  const Eigen::Matrix3d& R_level_cam;
  double threshold;  ///< [-] normalised
  const ConsensusOptions& options;
  PointSet points;  ///< all of them

  ConsensusProblem(AcSpan all, const Eigen::Matrix3d& level, double bound,
                   const ConsensusOptions& o)
      : acs(all), R_level_cam(level), threshold(bound), options(o), points(all) {}
};

/// The distinct motions that the points support, polished on all of them, best first: those of a
/// first look without a relative pitch where the best of them decides, else those of
/// the whole search. Empty when no correspondence gave a hypothesis.
[[nodiscard]] std::vector<Candidate> ranked_modes(const ConsensusProblem& problem,
                                                  RobustStatistics& statistics);

}  // namespace oneac::internal
