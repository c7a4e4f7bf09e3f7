#pragma once

#include "oneac/base/bound.h"
#include "oneac/loops/loop_keyframe.h"
#include "oneac/loops/pose_graph.h"
#include "oneac/loops/shared_patch.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace oneac {

/// The global bundle adjustment. validate() throws std::invalid_argument naming field, value and
/// bound.
struct GlobalOptions {
  /// Patches of a keyframe, and as many again of loops: what they share of their errors (lens,
  /// overlapping patches) makes more of them tell nothing new, see GlobalAdjustment.
  int patches = 100;
  int max_observations = 1000000;  ///< of the drive, 1 GB; patches of a keyframe are fewer beyond
  int max_iterations = 50;         ///< of either solution: bounds the time

  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

template <class Visitor>
void describe(Visitor&& visit, GlobalOptions& o) {
  visit("patches", o.patches, "count", "of a keyframe's tracks, and again of its loops",
        Bound::at_least(20));
  visit("max_observations", o.max_observations, "count", "of the drive, a kilobyte each",
        Bound::at_least(1000));
  visit("max_iterations", o.max_iterations, "count", "of the optimiser, twice", Bound::at_least(1));
}

/// Patches of a drive, as its camera's focal length has them.
struct DrivePatches {
  double focal_px = 1.0;
  std::vector<SharedPatch> patches;
};

/// How a global adjustment came out.
struct GlobalReport {
  bool adjusted = false;         ///< the poses are its own; else they are the pose graph's ...
  std::string reason;            ///< ... and this says why, else ""
  std::size_t patches = 0;       ///< that took part
  std::size_t observations = 0;  ///< of them, in the last solution
  std::size_t shared = 0;        ///< patches that loops have brought together
  std::size_t loops = 0;         ///< that came in as images instead of as an edge
  std::size_t inconsistent = 0;  ///< observations left out: their affinity contradicts the patch
  std::size_t rejected = 0;      ///< observations left out: far from where the solution has them
  std::size_t passed_over = 0;   ///< patches beyond the bound on size
  double rms_before_px = 0.0;    ///< of the observations, by the poses of the pose graph
  double rms_after_px = 0.0;
  int iterations = 0;  ///< of both solutions together
};

struct GlobalAdjustment {
  std::vector<Eigen::Isometry3d> T_first_cam;  ///< one per keyframe, in the frames of the graph
  std::vector<std::optional<Eigen::Vector3d>> points;  ///< one per patch of the drive [m]
  GlobalReport report;
};

/// Bundle adjustment over all keyframes of a closed drive and the patches that they saw:
/// reprojection of every affine-consistent observation in standard deviations under a Cauchy loss,
/// patches eliminated (Ceres, sparse Schur, one thread). A loop enters by its patches, which both
/// its ends saw, and as an edge where too few of them are left. Metres stay the odometry's: its
/// steps enter with their covariance, lengths by the road or another source included. The first
/// keyframe of each frame holds the gauge.
///
/// Neighbouring patches share their errors, as the steps of the drive have it: variances count four
/// times. Observations beyond 99.9 % of the first solution are taken out before the second.
/// @param keyframes  as the graph was solved for
/// @param stop  asked between iterations: then the poses stay those of the graph
/// @throws std::invalid_argument for options out of bounds or a sighting of no keyframe
[[nodiscard]] GlobalAdjustment adjust_globally(const std::vector<LoopKeyframe>& keyframes,
                                               const ClosedGraph& closed, const DrivePatches& drive,
                                               const GlobalOptions& options,
                                               const std::function<bool()>& stop = {});

}  // namespace oneac
