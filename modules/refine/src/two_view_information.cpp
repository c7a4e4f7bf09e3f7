#include "two_view_information.h"

#include "oneac/geometry/essential.h"
#include "oneac/geometry/robust_loss.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace oneac {
namespace {

using Matrix5 = Eigen::Matrix<double, 5, 5>;
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

/// M and V of the header, summed over all terms.
struct Sandwich {
  Matrix5 M = Matrix5::Zero();
  Matrix5 V = Matrix5::Zero();

  template <int N>
  void add(const EpipolarTerm<N>& term, const RelativePose& pose, const Matrix65& basis,
           double loss_sigmas) {
    Eigen::Matrix<double, N, 5> J;
    for (int k = 0; k < N; ++k) J.row(k) = pose_derivative(term.dE[k], pose) * basis;
    const double c2 = loss_sigmas * loss_sigmas;
    const double weight = cauchy_weight(term.r.squaredNorm(), c2);
    const Eigen::Matrix<double, 1, 5> rJ = term.r.transpose() * J;
    const Matrix5 squared_slope = weight * weight * rJ.transpose() * rJ;
    M += weight * J.transpose() * J - 2.0 / c2 * squared_slope;
    V += squared_slope + kSmallestVariance * J.transpose() * J;
  }
};

}  // namespace

Eigen::Matrix<double, 6, 6> two_view_information(const TwoViewTerms& terms,
                                                 const RelativePose& pose) {
  const Eigen::Matrix3d E = essential_matrix(pose);
  const Matrix65 basis = tangent_basis(pose.t);
  Sandwich sums;
  for (std::size_t i = 0; i < terms.acs.size(); ++i) {
    const AffineCorrespondence& ac = terms.acs[i];
    if (terms.with_point[i]) {
      sums.add(point_term(E, ac, terms.noise), pose, basis, terms.loss_sigmas);
    }
    if (terms.with_affine[i]) {
      sums.add(affine_term(E, ac, terms.noise), pose, basis, terms.loss_sigmas);
    }
  }
  const Eigen::LDLT<Matrix5> V(sums.V);
  if (V.info() != Eigen::Success || !(V.rcond() > kSingular))
    return Eigen::Matrix<double, 6, 6>::Zero();
  const Matrix5 information = sums.M * V.solve(sums.M);
  if (!information.allFinite()) return Eigen::Matrix<double, 6, 6>::Zero();
  const Matrix5 symmetric = 0.5 * (information + information.transpose());
  return basis * symmetric * basis.transpose();
}

}  // namespace oneac
