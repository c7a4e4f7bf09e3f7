#pragma once

#include "oneac/solvers/planar_pose.h"
#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"

#include <limits>

namespace oneac {

/// Planar motion, |t| = 1, and the focal length that both views share.
struct PlanarFocalPose : PlanarPose {
  double focal = 1.0;  ///< true over assumed focal length; pixels for points in pixels
  /// |sin α sin(2 η + α)|, η the heading of t: how well the motion shows the focal length. The
  /// error of ln f is that of the correspondence over it; on a straight road, and on the circle of
  /// a camera above the rear axle, it is zero and `focal` anything.
  double strength = 0.0;
};

constexpr double kAnyFocal = std::numeric_limits<double>::infinity();

/// Planar motion and an unknown common focal length from one affine correspondence on any surface.
///
/// Model: F = K⁻ᵀ E K⁻¹ has the four entries of the planar E, f² F12 = E12, f² F21 = E21,
/// f F23 = E23, f F32 = E32; three equations give F, and E21² + E23² = E12² + E32² gives
/// f² = (F32² − F23²) / (F21² − F12²). docs/solvers/relpose_1ac_planar_focal.md
/// Source: the problem is Hajder and Barath's, "Relative planar motion for vehicle-mounted cameras
/// from a single affine correspondence", ICRA 2020, arXiv 1912.06465, and the third case of Guan et
/// al., CVPR 2020, arXiv 1912.10776; the derivation is our own.
/// @param ac         x1, x2: image points about the principal point over an assumed focal length
///                   [-], or in pixels; A: ∂x2/∂x1 [-]; square pixels; Y along gravity in both
///                   views
/// @param max_ratio  keeps solutions with 1/max_ratio ≤ focal ≤ max_ratio; any with points in
/// pixels
/// @return           at most one pose T_2_1 with its focal length; the sign of t puts the point in
///                   front of both cameras
/// @degenerate       as relpose_1ac_planar, and f² not positive or not determined (no turn, a turn
///                   on a circle about an axis beside the camera): empty. With noise such motions
///                   give a focal length of strength about zero: weigh by it, see there
/// @cost             about 80 ns, no allocation; pure, thread-safe
[[nodiscard]] SolutionSet<PlanarFocalPose, 1> relpose_1ac_planar_focal(
    const AffineCorrespondence& ac, double max_ratio = kAnyFocal);

/// The same from N ≥ 1 correspondences in algebraic least squares; `weights` may be null. Three
/// unknowns are what the four entries of F leave, so no constraint is lost.
[[nodiscard]] SolutionSet<PlanarFocalPose, 1> relpose_nac_planar_focal(
    AcSpan acs, const double* weights = nullptr, double max_ratio = kAnyFocal);

}  // namespace oneac
