#pragma once

#include "oneac/refine/epipolar_terms.h"

#include <Eigen/Core>

#include <vector>

namespace oneac {

/// What the residuals of one pair are made of. Borrows; lives within one call.
struct TwoViewTerms {
  const std::vector<AffineCorrespondence>& acs;
  const std::vector<bool>& with_point;     ///< these contribute a point term
  const std::vector<bool>& with_affine;    ///< these contribute an affine term
  std::vector<CorrespondenceNoise> noise;  ///< one per correspondence
  double loss_sigmas;
};

/// What a pair's terms tell of (w, v), R ← exp([w]×) R, t ← t + v, |t| = 1; of v along t nothing.
struct TwoViewInformation {
  Eigen::Matrix<double, 6, 6> information;  ///< of terms that share no errors, and of the prior
  Eigen::Matrix<double, 6, 6> shared;       ///< covariance that comes to that by those they share
};

/// At a minimum the information is M V⁻¹ M, the inverse of the covariance of an M-estimator, with M
/// the curvature of the cost (Gauss–Newton part) and V the sum of the squared gradients of its
/// terms. It follows the scatter that the residuals have, not the one the options assume, and near
/// points may scatter more than far ones. A term that the fit follows has a small residual because
/// of that: each is taken as it would be without its term, (1 − leverage)⁻¹ r, so that a handful of
/// near points among far ones claims no more than it knows. Rank five; zero when a direction is not
/// observed.
/// Neighbours in the image share errors (a lens, a rolling shutter): by what cells of the image
/// have beyond V (GradientsOfCells), M⁻¹ times that times M⁻¹ is the covariance that they add.
/// Source: Huber, Robust Statistics, section 6.3 (the "sandwich"); MacKinnon and White, Journal of
/// Econometrics 29, 1985 (leverage, their HC3).
/// @param of_prior  information of what is expected beside the terms
[[nodiscard]] TwoViewInformation two_view_information(const TwoViewTerms& terms,
                                                      const RelativePose& pose,
                                                      const Eigen::Matrix<double, 6, 6>& of_prior);

}  // namespace oneac
