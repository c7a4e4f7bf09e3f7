#pragma once

#include "oneac/geometry/relative_pose.h"
#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"

namespace oneac {

/// Any motion between upright views: yaw by α about the vertical (Y) axis and any translation.
struct UprightPose {
  double cos_alpha = 1.0;
  double sin_alpha = 0.0;
  Eigen::Vector3d t = Eigen::Vector3d::Zero();  ///< |t| = 1

  [[nodiscard]] RelativePose pose() const { return {yaw_rotation(cos_alpha, sin_alpha), t}; }
};

/// Relative pose with a known vertical direction in both views and any translation, slopes and
/// kerbs included, from one affine correspondence on any surface.
///
/// Model: the epipolar and the two affine-epipolar equations are M(α) t = 0 with M linear in
/// (cos α, sin α): det M(α) = 0 is a quartic in tan α'/2, where α' is the yaw of views turned so
/// that the point lies straight ahead. docs/solvers/relpose_1ac_vertical.md
/// Source: the problem is the fourth case of Guan, Zhao, Li, Sun, Fraundorfer, "Minimal Solutions
/// for Relative Pose with a Single Affine Correspondence", CVPR 2020, arXiv 1912.10776; the
/// derivation is our own.
/// @param ac   x1, x2: normalised image points [-]; A: ∂x2/∂x1 [-]; Y axis along gravity in both
///             views (solve_tilted of gravity.h turns them there)
/// @return     up to four poses T_2_1 (the true one among them), |t| = 1, each with the point
///             before both cameras; no length
/// @degenerate pure rotation, no motion, det A ≤ 0, not finite: empty. The horizon is none
/// @cost       about 300 ns, no allocation; pure, thread-safe
[[nodiscard]] SolutionSet<UprightPose, 4> relpose_1ac_vertical(const AffineCorrespondence& ac);

/// Algebraic least squares over N ≥ 1 correspondences on any surfaces; `weights` (one each, ≥ 0)
/// may be null. Descends from the minimal solutions of up to sixteen of them; the least cost wins,
/// and the sign of t follows the majority of the points. From a single one, which leaves several
/// solutions of equal cost, all of them as relpose_1ac_vertical gives them.
[[nodiscard]] SolutionSet<UprightPose, 4> relpose_nac_vertical(AcSpan acs,
                                                               const double* weights = nullptr);

}  // namespace oneac
