#include "two_view_information.h"

#include "oneac/geometry/essential.h"
#include "oneac/geometry/robust_loss.h"
#include "oneac/geometry/shared_errors.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace oneac {
namespace {

using Matrix5 = Eigen::Matrix<double, 5, 5>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix65 = Eigen::Matrix<double, 6, 5>;

// A smaller ratio of pivots: some direction is not observed at all.
constexpr double kSingular = 1e-14;
// Residuals of exact data vanish; no image point is known better than a thousandth of the noise.
constexpr double kSmallestVariance = 1e-6;

/// From five tangent numbers to (w, v), v perpendicular to t.
Matrix65 tangent_basis(const Eigen::Vector3d& t) {
  Matrix65 basis = Matrix65::Zero();
  basis.topLeftCorner<3, 3>().setIdentity();
  const Eigen::Vector3d first = t.unitOrthogonal();
  basis.block<3, 1>(3, 3) = first;
  basis.block<3, 1>(3, 4) = t.cross(first);
  return basis;
}

/// [-] A term whose residual the fit could choose freely to this share says nothing of the noise.
constexpr double kMostLeverage = 0.98;

// [-] Where few terms tell, their own residuals tell the noise poorly, and that of all terms is
// added: in full from a leverage of a quarter on, which eight points have that tell two numbers.
constexpr double kOfOthers = 4.0;

/// One term's residual, its derivative in the tangent space, and its robust weight.
template <int N>
struct Linearised {
  Eigen::Matrix<double, N, 1> r;
  Eigen::Matrix<double, N, 5> J;
  double weight = 0.0;
  Eigen::Vector2d x = Eigen::Vector2d::Zero();  ///< where it lies in the first image
};

template <int N>
Linearised<N> linearised(const EpipolarTerm<N>& term, const RelativePose& pose,
                         const Matrix65& basis, double loss_sigmas, const Eigen::Vector2d& x) {
  Linearised<N> result;
  result.x = x;
  result.r = term.r;
  for (int k = 0; k < N; ++k) result.J.row(k) = pose_derivative(term.dE[k], pose) * basis;
  result.weight = cauchy_weight(term.r.squaredNorm(), loss_sigmas * loss_sigmas);
  return result;
}

/// All terms of one kind.
template <int N>
using Terms = std::vector<Linearised<N>>;

/// What all terms have in common, to judge each one by.
struct Common {
  Matrix5 normal = Matrix5::Zero();
  Matrix5 inverse = Matrix5::Zero();  ///< of the normal matrix
  double weights = 0.0;
  double squares = 0.0;

  template <int N>
  void add(const Terms<N>& terms) {
    for (const Linearised<N>& term : terms) {
      normal += term.weight * term.J.transpose() * term.J;
      weights += N * term.weight;
      squares += term.weight * term.r.squaredNorm();
    }
  }
  /// Of one residual, robustly.
  [[nodiscard]] double variance() const { return weights > 0.0 ? squares / weights : 0.0; }
};

/// M and V of the header, summed over all terms.
struct Sandwich {
  Matrix5 M = Matrix5::Zero();
  Matrix5 V = Matrix5::Zero();
  GradientsOfCells<5> cells;

  template <int N>
  void add(const Terms<N>& terms, const Common& common, double loss_sigmas) {
    for (const Linearised<N>& term : terms) add(term, common, loss_sigmas);
  }

  template <int N>
  void add(const Linearised<N>& term, const Common& common, double loss_sigmas) {
    using MatrixN = Eigen::Matrix<double, N, N>;
    const Eigen::Matrix<double, 1, 5> rJ = term.r.transpose() * term.J;
    const double squared_weight = term.weight * term.weight;
    M += term.weight * term.J.transpose() * term.J -
         2.0 / (loss_sigmas * loss_sigmas) * squared_weight * rJ.transpose() * rJ;
    const MatrixN leverage = term.weight * term.J * common.inverse * term.J.transpose();
    const MatrixN kept =
        MatrixN::Identity() - leverage * std::min(1.0, kMostLeverage / leverage.trace());
    const Eigen::Matrix<double, 1, 5> freed = (kept.inverse() * term.r).transpose() * term.J;
    cells.add(term.x, term.weight * freed.transpose());
    const double by_others = std::min(kOfOthers * leverage.trace(), 1.0) * common.variance();
    V += squared_weight * (freed.transpose() * freed + by_others * term.J.transpose() * term.J) +
         kSmallestVariance * term.J.transpose() * term.J;
  }
};

/// What a pose that follows from the terms and a prior has of gradients that vary so.
Matrix6 covariance_of(const Matrix5& gradients, const Matrix5& curvature, const Matrix65& basis) {
  const Eigen::LDLT<Matrix5> factor(curvature);
  if (factor.info() != Eigen::Success || !(factor.rcond() > kSingular)) return Matrix6::Zero();
  const Matrix5 half = factor.solve(gradients);
  const Matrix5 covariance = factor.solve(half.transpose());
  if (!covariance.allFinite()) return Matrix6::Zero();
  return basis * (0.5 * (covariance + covariance.transpose())) * basis.transpose();
}

}  // namespace

TwoViewInformation two_view_information(const TwoViewTerms& terms, const RelativePose& pose,
                                        const Matrix6& of_prior) {
  const Eigen::Matrix3d E = essential_matrix(pose);
  const Matrix65 basis = tangent_basis(pose.t);
  Terms<1> points;
  Terms<2> affinities;
  for (std::size_t i = 0; i < terms.acs.size(); ++i) {
    const AffineCorrespondence& ac = terms.acs[i];
    if (terms.with_point[i]) {
      points.push_back(
          linearised(point_term(E, ac, terms.noise[i]), pose, basis, terms.loss_sigmas, ac.x1));
    }
    if (terms.with_affine[i]) {
      affinities.push_back(
          linearised(affine_term(E, ac, terms.noise[i]), pose, basis, terms.loss_sigmas, ac.x1));
    }
  }
  Common common;
  common.add(points);
  common.add(affinities);
  const Eigen::LDLT<Matrix5> factor(common.normal);
  TwoViewInformation result{of_prior, Matrix6::Zero()};
  if (factor.info() != Eigen::Success || !(factor.rcond() > kSingular)) return result;
  common.inverse = factor.solve(Matrix5::Identity());
  Sandwich sums;
  sums.cells.reserve(points.size() + affinities.size());
  sums.add(points, common, terms.loss_sigmas);
  sums.add(affinities, common, terms.loss_sigmas);
  const Eigen::LDLT<Matrix5> V(sums.V);
  if (V.info() != Eigen::Success || !(V.rcond() > kSingular)) return result;
  const Matrix5 information = sums.M * V.solve(sums.M);
  if (!information.allFinite()) return result;
  const Matrix5 symmetric = 0.5 * (information + information.transpose());
  result.information += basis * symmetric * basis.transpose();
  result.shared = covariance_of(sums.cells.shared(sums.V),
                                sums.M + basis.transpose() * of_prior * basis, basis);
  return result;
}

}  // namespace oneac
