#pragma once

#include "oneac/loops/global_adjustment.h"
#include "oneac/loops/loop_constraint.h"
#include "oneac/loops/shared_patch.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <vector>

namespace oneac::internal {

/// A patch in the global adjustment: ray and inverse depth in a frame that does not move, where its
/// first keyframe was at the start. A point however far away has finite numbers.
struct GlobalPatch {
  std::optional<std::size_t> track;  ///< which of the drive's patches; none: of loops
  SharedPatch sightings;
  Eigen::Isometry3d T_frame_anchor = Eigen::Isometry3d::Identity();
  Eigen::Vector3d m = Eigen::Vector3d::Zero();  ///< x, y [-], inverse depth [1/m]
  double depth_information = 0.0;               ///< of ln(depth): 1 / relative variance
};

/// T_frame_cam of all keyframes.
using Poses = std::vector<Eigen::Isometry3d>;

/// Tracks of the drive as patches with a depth; without those that no depth explains.
[[nodiscard]] std::vector<GlobalPatch> patches_of_tracks(const DrivePatches& drive,
                                                         const Poses& poses);

/// The same of loops: what several loops have of one feature is one patch.
[[nodiscard]] std::vector<GlobalPatch> patches_of_loops(const std::vector<LoopConstraint>& loops,
                                                        const Poses& poses);

/// As many as give every keyframe `most` of them, if there are; half of them those seen longest,
/// which hold turns, and half those whose depth is known best, which hold the way.
[[nodiscard]] std::vector<GlobalPatch> chosen(std::vector<GlobalPatch> patches,
                                              std::size_t keyframes, std::size_t most);

[[nodiscard]] std::size_t observations_of(const std::vector<GlobalPatch>& patches);

/// Leaves out the sightings whose affinity contradicts the patch that the others and the poses make
/// of it, as refine's fit_patches() judges, and patches that are left with one.
/// @return how many sightings
std::size_t keep_affine_consistent(const Poses& poses, std::vector<GlobalPatch>& patches);

}  // namespace oneac::internal
