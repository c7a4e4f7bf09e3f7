#pragma once

#include "oneac/geometry/affine_correspondence.h"
#include "oneac/geometry/relative_pose.h"

#include <Eigen/Core>

#include <optional>

namespace oneac {

/// What an affinity leaves out of a plane seen by two cameras: around x1 the plane maps as
/// δ ↦ A δ (1 − η·δ) + O(δ³), and η [1/units of x1] is what this returns.
///
/// Model: y = (R + t mᵀ) (x1, 1), A = Dπ(y) (R + t mᵀ)₂, η = ∂(log y_z)/∂x1; the plane m·X = 1
/// through the triangulated point has m = (g, ρ − g·x1), and A is linear in g.
/// @param ac  normalised
/// @param T_2_1  t of any length
/// @param affine_sigma  1σ of an entry of A [-]: against it g is held near 0, a plane that faces
///                      the first camera, where the parallax says little
/// @degenerate rays parallel, point behind a camera: empty
[[nodiscard]] std::optional<Eigen::Vector2d> perspective_of(const AffineCorrespondence& ac,
                                                            const RelativePose& T_2_1,
                                                            double affine_sigma);

}  // namespace oneac
