#pragma once

#include "oneac/geometry/affine_correspondence.h"
#include "oneac/solvers/planar_pose.h"
#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"
#include "oneac/solvers/wall_pose.h"

#include <Eigen/Core>

#include <optional>

namespace oneac::internal {

/// Normal equations of A x = b, eqs. (9) and (10), over any number of correspondences on a plane of
/// known normal: products of the columns of A = (c | s | p | q) and b. Unknowns (cos α, sin α,
/// p = t_x/d, q = t_z/d) with n·X = d, so that p and q carry the sign of d (the paper's walls have
/// the opposite sign). p·b is always zero.
struct PlaneGram {
  double cc = 0.0, cs = 0.0, ss = 0.0, cp = 0.0, sp = 0.0, cq = 0.0, sq = 0.0;
  double pp = 0.0, pq = 0.0, qq = 0.0, cb = 0.0, sb = 0.0, qb = 0.0, bb = 0.0;

  /// Adds the six rows of one correspondence, weighted.
  void add(const AffineCorrespondence& ac, const Eigen::Vector3d& n, double weight);
  /// Adds the two rows of its points, eq. (4), only.
  void add_points(const AffineCorrespondence& ac, const Eigen::Vector3d& n, double weight);
};

/// Solution (cos α, sin α, p, q) with a unit (cos α, sin α).
struct PlaneSolution {
  double c, s, p, q;
};

/// Homogeneous least squares: the eigenvector of the smallest eigenvalue of [A | −b]ᵀ[A | −b],
/// scaled to a last entry of one, then (c, s) normalised. Empty when the last entry vanishes or the
/// null space is not unique.
[[nodiscard]] std::optional<PlaneSolution> solve_rapid(const PlaneGram& gram);

/// min |A x − b|² subject to c² + s² = 1. Empty when p, q are not determined.
[[nodiscard]] std::optional<PlaneSolution> solve_optimal(const PlaneGram& gram);

/// How the two forms of a solver differ.
using PlaneSolve = std::optional<PlaneSolution> (*)(const PlaneGram&);

/// A plane of known normal as one solver sees it.
struct KnownPlane {
  Eigen::Vector3d n;                              ///< its normal, up to the sign of d
  bool (*may_show)(const AffineCorrespondence&);  ///< whether the point can lie on it usefully
  bool points_only = false;                       ///< leave the affinities out
};

/// The whole solver: correspondences on the plane to the pose with t in units of |d|. Empty when
/// none is usable, without motion, or when the plane would end up behind the second camera.
[[nodiscard]] SolutionSet<PlanarPose, 1> relpose_known_plane(const KnownPlane& plane, AcSpan acs,
                                                             const double* weights,
                                                             PlaneSolve solve);

/// The same for a vertical plane: the normal, turned towards the wall, comes with the pose.
[[nodiscard]] SolutionSet<WallPose, 1> relpose_known_wall(const KnownPlane& plane, AcSpan acs,
                                                          const double* weights, PlaneSolve solve);

/// Finite points; the affinity is not looked at.
[[nodiscard]] inline bool has_points(const AffineCorrespondence& ac) {
  return ac.x1.allFinite() && ac.x2.allFinite();
}

/// Finite, not mirrored.
[[nodiscard]] inline bool is_usable(const AffineCorrespondence& ac) {
  return ac.is_finite() && ac.A.determinant() > 0.0;
}

}  // namespace oneac::internal
