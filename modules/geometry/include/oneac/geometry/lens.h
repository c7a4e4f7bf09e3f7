#pragma once

#include "oneac/geometry/camera.h"

#include <Eigen/Core>

#include <optional>

namespace oneac {

/// Where a camera's lens puts the direction (x, y, 1), by any LensModel.
/// @param x  normalised coordinates [-]
/// @return   normalised coordinates of the raw image [-]: project() gives its pixel. Beyond a fold
///           of the polynomial the model means nothing, and so does this.
[[nodiscard]] Eigen::Vector2d distorted(const PinholeCamera& camera, const Eigen::Vector2d& x);

/// The inverse of distorted(): the direction of a place in the raw image, as normalised coordinates
/// of a pinhole camera. None beyond a fold of the polynomial, or 89° and more off the axis.
[[nodiscard]] std::optional<Eigen::Vector2d> undistorted(const PinholeCamera& camera,
                                                         const Eigen::Vector2d& x);

/// Whether k1 k2 p1 p2 k3 tell all of the lens: what formulas of these five need to hold.
[[nodiscard]] bool is_five_term_lens(const PinholeCamera& camera);

}  // namespace oneac
