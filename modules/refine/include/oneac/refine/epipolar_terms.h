#pragma once

#include "oneac/geometry/affine_correspondence.h"
#include "oneac/geometry/relative_pose.h"

#include <Eigen/Core>

namespace oneac {

/// Standard deviations of a measured correspondence, independent and the same for every entry.
struct CorrespondenceNoise {
  double point = 1.0;   ///< of each coordinate of x1 and x2 [-]
  double affine = 1.0;  ///< of each entry of A [-]
};

/// A residual of N numbers in standard deviations, and its derivative with respect to E.
template <int N>
struct EpipolarTerm {
  Eigen::Matrix<double, N, 1> r = Eigen::Matrix<double, N, 1>::Zero();
  /// dE[k](i, j) = ∂r(k) / ∂E(i, j)
  Eigen::Matrix3d dE[N] = {};
};

/// Sampson distance over its standard deviation, which is noise.point: first order, the distance
/// of the point pair from the nearest pair that obeys E. Zero where both epipolar lines vanish.
/// Source: Hartley and Zisserman, Multiple View Geometry, eq. (11.9).
[[nodiscard]] EpipolarTerm<1> point_term(const Eigen::Matrix3d& E, const AffineCorrespondence& ac,
                                         const CorrespondenceNoise& noise);

/// The two affine-epipolar equations e = Aᵀ (E x1)₁₂ + (Eᵀ x2)₁₂ over their standard deviation s,
/// by first-order propagation with E₂₂ the upper left block of E:
///   s² = affine² |(E x1)₁₂|² + point² (|Aᵀ E₂₂|² + |E₂₂|²) / 2   (Frobenius norms)
/// The first part is exact for both equations; the second, their mean, matters only close to the
/// epipole. Free of the scale of E. Zero where s vanishes.
[[nodiscard]] EpipolarTerm<2> affine_term(const Eigen::Matrix3d& E, const AffineCorrespondence& ac,
                                          const CorrespondenceNoise& noise);

/// From ∂r/∂E to (w, v) of R ← exp([w]×) R, t ← t + v, with E = [t]× R.
[[nodiscard]] Eigen::Matrix<double, 1, 6> pose_derivative(const Eigen::Matrix3d& dE,
                                                          const RelativePose& pose);

}  // namespace oneac
