#pragma once

#include "oneac/geometry/affine_correspondence.h"
#include "oneac/geometry/relative_pose.h"

#include <Eigen/Core>

#include <array>

namespace oneac {

/// E = [t]× R, so that x2ᵀ E x1 = 0. The scale of t is kept.
[[nodiscard]] Eigen::Matrix3d essential_matrix(const RelativePose& T_2_1);

/// The four motions (R, ±t), (R', ±t) of an essential matrix, |t| = 1. A matrix without a second
/// singular value gives what the SVD gives.
/// @throws std::invalid_argument when E is not finite
[[nodiscard]] std::array<RelativePose, 4> decompose_essential(const Eigen::Matrix3d& E);

/// Signed Sampson distance: first-order geometric error of a point pair against E, in the units
/// of the normalised image plane; times the focal length it is pixels. Zero when both epipolar
/// lines are undefined.
/// Source: Hartley and Zisserman, Multiple View Geometry, eq. (11.9).
[[nodiscard]] double sampson_distance(const Eigen::Matrix3d& E, const Eigen::Vector2d& x1,
                                      const Eigen::Vector2d& x2);

/// The two affine-epipolar equations Aᵀ (E x1)₁₂ + (Eᵀ x2)₁₂, zero for a consistent affinity.
/// They are linear in E and in A; divide by the length of (Eᵀ x2)₁₂ to make them free of scale.
[[nodiscard]] Eigen::Vector2d affine_epipolar_residual(const Eigen::Matrix3d& E,
                                                       const AffineCorrespondence& ac);

}  // namespace oneac
