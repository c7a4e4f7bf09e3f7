#pragma once

#include "oneac/geometry/relative_pose.h"
#include "oneac/robust/one_ac_consensus.h"
#include "oneac/solvers/span.h"

#include <cstddef>
#include <vector>

namespace oneac::internal {

/// A pose of the tilted camera with its cost on a sample of the points.
struct Candidate {
  RelativePose pose;  ///< |t| = 1, sign as the solver gave it
  double cost = 0.0;
};

struct SearchResult {
  std::vector<Candidate> best;  ///< best first
  std::size_t solved = 0;       ///< minimal problems
  std::size_t hypotheses = 0;   ///< their valid solutions, all scored
};

/// Solves every correspondence with every chosen solver at every relative pitch and roll of the
/// second view, scores each pose on a sample of the points and keeps the best `keep`.
[[nodiscard]] SearchResult search_poses(AcSpan acs, const Eigen::Matrix3d& R_level_cam,
                                        double threshold, std::size_t keep,
                                        const ConsensusOptions& options);

/// The same for about `options.first_problems` of the correspondences, evenly spaced, without a
/// relative pitch or roll.
[[nodiscard]] SearchResult search_level_poses(AcSpan acs, const Eigen::Matrix3d& R_level_cam,
                                              double threshold, std::size_t keep,
                                              const ConsensusOptions& options);

}  // namespace oneac::internal
