#pragma once

#include "oneac/geometry/affine_correspondence.h"
#include "oneac/geometry/relative_pose.h"

#include <Eigen/Core>

#include <optional>

namespace oneac {

/// A plane in the frame of the first camera: n·X = d, |n| = 1.
///
/// This is the project's only sign convention for planes. The ground under a camera with Y down is
/// n = (0, 1, 0), d = camera height > 0. (The paper writes n·X + d = 0.)
struct Plane {
  Eigen::Vector3d n = Eigen::Vector3d::UnitY();
  double d = 1.0;  ///< [length of the pose's t]
};

/// H = R + t nᵀ / d, which maps x1 to x2 for points on the plane
/// [Gal 2020, eq. (1), with the sign of n·X = d].
/// @pre d ≠ 0
[[nodiscard]] Eigen::Matrix3d plane_induced_homography(const RelativePose& T_2_1,
                                                       const Plane& plane);

/// Where H maps x1 and how it maps its neighbourhood (A = ∂x2/∂x1)   [Gal 2020, eqs. (4), (5)].
/// Empty when x1 goes to infinity or behind the second camera (third coordinate ≤ 0), and for
/// numbers that are not finite.
[[nodiscard]] std::optional<AffineCorrespondence> correspondence_from_homography(
    const Eigen::Matrix3d& H, const Eigen::Vector2d& x1);

/// The six equations of one correspondence on a homography, eq. (4) first, then eq. (5); zero when
/// the correspondence obeys H.
[[nodiscard]] Eigen::Matrix<double, 6, 1> homography_residual(const Eigen::Matrix3d& H,
                                                              const AffineCorrespondence& ac);

/// The same correspondence seen by cameras that were rotated about their centres: a ray r1 of the
/// first view becomes Q1 r1, a ray r2 of the second Q2 r2. The affinity follows by the chain rule.
/// Empty when a point leaves the half-space in front of its rotated camera, and for numbers that
/// are not finite.
[[nodiscard]] std::optional<AffineCorrespondence> rotate_views(const AffineCorrespondence& ac,
                                                               const Eigen::Matrix3d& Q1,
                                                               const Eigen::Matrix3d& Q2);

/// The normal n (unit, any sign such that n·X > 0) and d of the local plane that one affine
/// correspondence sees when the motion is known: least squares over eqs. (4), (5) in n/d.
/// Empty when the motion has no translation or the plane passes through the camera centre.
[[nodiscard]] std::optional<Plane> plane_from_affinity(const RelativePose& T_2_1,
                                                       const AffineCorrespondence& ac);

}  // namespace oneac
