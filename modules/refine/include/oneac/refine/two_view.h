#pragma once

#include "oneac/base/bound.h"
#include "oneac/geometry/affine_correspondence.h"
#include "oneac/geometry/relative_pose.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace oneac {

/// Two-view refinement. validate() throws std::invalid_argument naming field, value and bound.
/// The noise figures are those of VLFeat's correspondences, docs/decisions/refine-two-view.md.
struct RefineOptions {
  double point_noise_px = 0.2;  ///< [px] 1σ of the Sampson distance of inliers: 0.16 … 0.22
  double affine_noise = 0.05;   ///< [-] 1σ of an entry of A: 0.03 … 0.08
  double loss_sigmas = 1.0;  ///< [σ] scale of the Cauchy loss: the residuals' tails are that long
  double model_noise_px =
      0.05;  ///< [px] 1σ beside a point's own: lens, shutter, what the best tracks leave
  int affine_terms_below =
      50;  ///< [inliers] with more, affinities add nothing but time; 0: points alone
  double affine_gate_sigmas =
      3.0;                  ///< [σ] norm of the two affine residuals; 99 % of Gaussian ones pass
  int max_iterations = 30;  ///< Levenberg–Marquardt steps: six on average, twelve with 20 inliers
  int min_inliers = 8;      ///< fewer leave too little redundancy over the five degrees of freedom

  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

/// Describes every option to a visitor: visit(key, field, unit, reason).
template <class Visitor>
void describe(Visitor&& visit, RefineOptions& o) {
  visit("point_noise_px", o.point_noise_px, "px", "1 sigma of an inlier's epipolar distance",
        Bound::positive_and_finite());
  visit("affine_noise", o.affine_noise, "-", "1 sigma of an entry of the affinity",
        Bound::positive_and_finite());
  visit("loss_sigmas", o.loss_sigmas, "sigma", "scale of the robust (Cauchy) loss",
        Bound::positive_and_finite());
  visit("model_noise_px", o.model_noise_px, "px",
        "1 sigma beside a point's own noise: lens, shutter", Bound::positive_and_finite());
  visit("affine_terms_below", o.affine_terms_below, "inliers",
        "pairs with fewer use affinities beside points; 0: never", Bound::at_least(0));
  visit("affine_gate_sigmas", o.affine_gate_sigmas, "sigma", "affinities beyond it are left out",
        Bound::at_least(0));
  visit("max_iterations", o.max_iterations, "count", "steps of the optimiser", Bound::at_least(1));
  visit("min_inliers", o.min_inliers, "count", "a pair with fewer is not refined",
        Bound::at_least(5));
}

/// How a refinement ended.
enum class RefineStatus {
  kConverged,      ///< the cost or the step became stationary
  kStopped,        ///< the limit of iterations came first; the pose is the best so far
  kTooFew,         ///< fewer inliers than min_inliers
  kNoTranslation,  ///< the start has t = 0: no epipolar geometry to refine
  kNotFinite,      ///< NaN, Inf or overflow in the start or in an inlier
  kFailed,         ///< the optimiser found no valid step
};
/// "converged", "too_few" and so on, for files.
[[nodiscard]] const char* to_string(RefineStatus status);

struct RefineResult {
  RefineStatus status = RefineStatus::kFailed;
  RelativePose pose;                    ///< refined, |t| as in the start; the start when not usable
  std::vector<bool> affine_consistent;  ///< one per correspondence; only inliers can be
  std::size_t affine_count = 0;         ///< how many are
  bool affine_used = false;             ///< they took part in the cost
  double initial_cost = 0.0;            ///< ½ Σ ρ(|r|²), r in standard deviations
  double final_cost = 0.0;              ///< never above initial_cost
  int iterations = 0;
  /// Information (inverse covariance) of (w, v): R ← exp([w]×) R, t/|t| ← t/|t| + v [rad], from the
  /// scatter of the residuals at the result. Rank five: nothing is known along t. Zero if unusable.
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  /// Covariance of the same by errors that neighbours in the image share (a lens, a shutter that
  /// rolls), beside that of independent ones, the information's inverse. Zero where they share
  /// none.
  Eigen::Matrix<double, 6, 6> shared_covariance = Eigen::Matrix<double, 6, 6>::Zero();

  /// The pose is refined: kConverged or kStopped.
  [[nodiscard]] bool usable() const {
    return status == RefineStatus::kConverged || status == RefineStatus::kStopped;
  }
};

/// A direction of translation that is expected beside what the images tell.
struct DirectionPrior {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< t̂ of T_2_1
  double sigma = 0.0;                                   ///< [rad] 1σ; 0: nothing is expected
};

/// What is known of a pair beside its correspondences.
struct KnownOfPair {
  DirectionPrior direction = {};  ///< adds ½ |t̂ − direction|² / σ² to the cost, its curvature to
                                  ///< the information
  /// 1σ of a coordinate of every correspondence [normalised], 0 where unknown; empty:
  /// point_noise_px holds for all
  std::vector<double> point_sigmas = {};
};

/// Two-view bundle adjustment over affine-consistent inliers, structure eliminated.
///
/// Minimises, over the five degrees of freedom of (R, t/|t|), the Sampson distances of all inliers
/// and, for pairs with few inliers, the affine-epipolar residuals of the affine-consistent ones,
/// each divided by its first-order standard deviation (epipolar_terms.h), under a Cauchy loss. To
/// first order this is the bundle adjustment with a depth and a plane normal per inlier: of the six
/// equations of a correspondence those three unknowns take three and leave the three used here.
///
/// An inlier is affine-consistent when at the start pose its affine residual is no longer than
/// affine_gate_sigmas; the set is fixed then, so that the cost that is lowered is one function.
///
/// @param acs      normalised correspondences
/// @param inliers  one flag per correspondence
/// @param start    X2 = R X1 + t; the length of t is kept, whether metric or one
/// @param focal_px turns point_noise_px into normalised units
/// @throws std::invalid_argument on invalid options, focal_px ≤ 0, flags or sigmas of another
/// number
/// @cost   1 to 2 ms for 600 inliers, twice that with affinities; one thread,
///         deterministic, prints nothing
[[nodiscard]] RefineResult refine_two_view(const std::vector<AffineCorrespondence>& acs,
                                           const std::vector<bool>& inliers,
                                           const RelativePose& start, double focal_px,
                                           const RefineOptions& options,
                                           const KnownOfPair& known = {});

}  // namespace oneac
