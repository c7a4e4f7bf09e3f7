#pragma once

#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace oneac {

/// The minimal solvers that a robust loop can be run with; modules/solvers describes each.
enum class MinimalMethod {
  k1acGround,       ///< relpose_1ac_ground
  k1acSideWall,     ///< relpose_1ac_side_wall
  k1acFrontWall,    ///< relpose_1ac_front_wall
  k1acWall,         ///< relpose_1ac_wall
  k1acPlanar,       ///< relpose_1ac_planar
  k1acPlanarPitch,  ///< relpose_1ac_planar_pitch
  k2pcGround,       ///< relpose_2pc_ground
  k3pcVertical,     ///< relpose_3pc_vertical
  k2pcPlanar,       ///< relpose_2pc_planar
  k1pcAckermann,    ///< relpose_1pc_ackermann
  k5pc,             ///< essential_5pc
  k8pc,             ///< essential_8pc
  k4pc,             ///< homography_4pc
  k2ac,             ///< homography_2ac
};

constexpr std::array<MinimalMethod, 14> kMinimalMethods = {
    MinimalMethod::k1acGround,    MinimalMethod::k1acSideWall, MinimalMethod::k1acFrontWall,
    MinimalMethod::k1acWall,      MinimalMethod::k1acPlanar,   MinimalMethod::k1acPlanarPitch,
    MinimalMethod::k2pcGround,    MinimalMethod::k3pcVertical, MinimalMethod::k2pcPlanar,
    MinimalMethod::k1pcAckermann, MinimalMethod::k5pc,         MinimalMethod::k8pc,
    MinimalMethod::k4pc,          MinimalMethod::k2ac};

/// At most ten: the five-point solver's.
using EssentialSet = SolutionSet<Eigen::Matrix3d, 10>;

constexpr std::size_t kLargestSample = 8;

/// What a loop has to know about a minimal solver.
struct MinimalModel {
  MinimalMethod method;
  const char* name;         ///< the paper's short name, such as "1ac_ground"
  std::size_t sample_size;  ///< correspondences
  bool planar;              ///< wants correspondences of the levelled cameras (Y along gravity)
  /// The essential matrices |E| = √2 of a sample: poses become [t]× R; homographies are decomposed
  /// and those of their motions kept that have the sample in front of both cameras.
  EssentialSet (*solve)(AcSpan sample);
};

[[nodiscard]] const MinimalModel& minimal_model(MinimalMethod method);

}  // namespace oneac
