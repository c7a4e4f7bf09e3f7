#pragma once

#include "points/five_point_cubics.h"
#include "points/five_rays.h"

namespace oneac::internal {

/// The same null space in coordinates in which the five-point problem is well scaled, however short
/// the translation.
///
/// With R the rotation that aligns the rays best and a parallax of size ε, the null space holds
/// three directions that are [t]× R but for ε, which fulfil the cubics for any t but for ε, and one
/// across them, of which a solution contains a share of ε. That one is shortened to ε; then all
/// coefficients of a solution, and all terms of the cubics that matter, are of one size. Last, the
/// basis is reflected at a plane without structure: planar motion has entries of E that vanish,
/// and the unknown set to one must not be among them.
/// @param basis  orthonormal null space of the five epipolar equations
[[nodiscard]] Basis well_scaled(const Basis& basis, const FiveRays& rays);

}  // namespace oneac::internal
