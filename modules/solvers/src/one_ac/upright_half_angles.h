#pragma once

#include "oneac/solvers/solution_set.h"

namespace oneac::internal {

/// A correspondence of upright views, each turned about the vertical until its point lies straight
/// ahead: x1 = (0, y), x2 = (0, v), A = [a1 a2; a3 a4].
struct AheadCorrespondence {
  double y, v;
  double a1, a2, a3, a4;
};

/// The real roots τ = tan α/2 of det M(α) = 0, M the three equations on t; α is the yaw between the
/// turned views.
///
/// The quartic −a2 σ² τ⁴ − 2 σ (a1 + a4) τ³ − 4 a3 τ² + 2 δ (a1 − a4) τ + a2 δ², σ = v + y,
/// δ = v − y, is the intersection of two hyperbolas, a2 μ ς + a1 μ + a4 ς + a3 = 0 and
/// ς² − μ² = v² − y², in μ, ς = (σ τ ∓ δ / τ) / 2. One real root of the pencil's cubic splits it
/// into two lines, each of which is a quadratic in τ. All coefficients shrink with the parallax
/// alike, so that a short translation costs no digits. docs/solvers/relpose_1ac_vertical.md
[[nodiscard]] SolutionSet<double, 4> upright_half_angles(const AheadCorrespondence& ac);

}  // namespace oneac::internal
