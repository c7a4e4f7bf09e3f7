#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

namespace oneac {

/// A point pair with the local affinity between its neighbourhoods.
///
/// Normalised image coordinates (X right, Y down, at depth Z = 1): x2 ≈ x1 mapped by the motion,
/// and A = ∂x2/∂x1, so that a small step dx1 in the first view becomes A dx1 in the second.
struct AffineCorrespondence {
  Eigen::Vector2d x1 = Eigen::Vector2d::Zero();     ///< first view [-]
  Eigen::Vector2d x2 = Eigen::Vector2d::Zero();     ///< second view [-]
  Eigen::Matrix2d A = Eigen::Matrix2d::Identity();  ///< ∂x2/∂x1 [-]

  /// Neither NaN nor Inf in points and affinity.
  [[nodiscard]] bool is_finite() const { return x1.allFinite() && x2.allFinite() && A.allFinite(); }
};

/// The correspondence of the swapped views. @pre det A ≠ 0
[[nodiscard]] inline AffineCorrespondence swapped(const AffineCorrespondence& ac) {
  return {ac.x2, ac.x1, ac.A.inverse()};
}

}  // namespace oneac
