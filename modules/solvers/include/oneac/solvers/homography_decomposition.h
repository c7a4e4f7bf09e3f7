#pragma once

#include "oneac/geometry/relative_pose.h"
#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"

#include <Eigen/Core>

namespace oneac {

/// A motion seen through a plane: t in units of the plane's distance d > 0, n·X = d in the
/// first camera's frame.
struct PlanePose {
  RelativePose motion;
  Eigen::Vector3d n = Eigen::Vector3d::UnitZ();

  [[nodiscard]] RelativePose pose() const { return motion; }
  [[nodiscard]] Eigen::Vector3d normal() const { return n; }
};

/// All (R, t, n) with H ∝ R + t nᵀ: two and their twins with t and n turned around.
///
/// Source: Ma, Soatto, Košecká, Sastry, "An Invitation to 3-D Vision", section 5.3.3.
/// @param H     any scale, sign such that x2ᵀ H x1 > 0
/// @degenerate  a rotation (no translation), |t| above about 10⁴, not finite: empty. Motion along
///              the normal: both meet
/// @cost        about 1 µs, no allocation
[[nodiscard]] SolutionSet<PlanePose, 4> decompose_homography(const Eigen::Matrix3d& H);

/// Those of them that have most points in front of both cameras: at most two.
[[nodiscard]] SolutionSet<PlanePose, 2> poses_from_homography(const Eigen::Matrix3d& H,
                                                              AcSpan points);

}  // namespace oneac
