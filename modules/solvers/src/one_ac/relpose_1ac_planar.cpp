#include "oneac/solvers/relpose_1ac_planar.h"

#include "math/least_squares_null_vector.h"
#include "math/thresholds.h"
#include "math/usable.h"
#include "planes/planar_entries.h"

#include <Eigen/Dense>

namespace oneac {
namespace {

using Rows = Eigen::Matrix<double, 3, 4>;

// The second eigenvalue of the normal matrix below this share of the largest: not determined.
constexpr double kRankDeficient = 1e-12;

/// Epipolar row and the two affine-epipolar rows, unknowns (E12, E21, E23, E32).
[[nodiscard]] Rows epipolar_rows(const AffineCorrespondence& ac) {
  const double x = ac.x1.x(), y = ac.x1.y(), u = ac.x2.x(), v = ac.x2.y();
  const double a1 = ac.A(0, 0), a2 = ac.A(0, 1), a3 = ac.A(1, 0), a4 = ac.A(1, 1);
  Rows m;
  m << u * y, v * x, v, y,          // x2ᵀ E x1 = 0
      a1 * y, a3 * x + v, a3, 0.0,  // Aᵀ (E x1)₁₂ + (Eᵀ x2)₁₂ = 0, first row
      a2 * y + u, a4 * x, a4, 1.0;  // second row
  return m;
}

/// Signed 3×3 minors: the null vector of a 3×4 matrix.
[[nodiscard]] Eigen::Vector4d null_vector(const Rows& m) {
  const auto minor = [&m](int a, int b, int c) {
    return m(0, a) * (m(1, b) * m(2, c) - m(1, c) * m(2, b)) -
           m(0, b) * (m(1, a) * m(2, c) - m(1, c) * m(2, a)) +
           m(0, c) * (m(1, a) * m(2, b) - m(1, b) * m(2, a));
  };
  return {minor(1, 2, 3), -minor(0, 2, 3), minor(0, 1, 3), -minor(0, 1, 2)};
}

}  // namespace

SolutionSet<PlanarPose, 1> relpose_1ac_planar(const AffineCorrespondence& ac) {
  if (!internal::is_usable(ac)) return {};
  const Rows rows = epipolar_rows(ac);
  const Eigen::Vector4d e = null_vector(rows);
  const double lengths = rows.row(0).norm() * rows.row(1).norm() * rows.row(2).norm();
  if (!(e.norm() > internal::kParallelRows * lengths)) return {};
  return internal::with_sign(internal::pose_from_entries(e), AcSpan(&ac, 1), nullptr,
                             internal::EpipolarRows::kAffine);
}

SolutionSet<PlanarPose, 1> relpose_nac_planar(AcSpan acs, const double* weights) {
  if (acs.size() == 1 && weights == nullptr)
    return relpose_1ac_planar(acs[0]);  // the minors keep twice the digits
  const auto e = internal::least_squares_null_vector<4>(
      [&](auto&& use) {
        for (std::size_t i = 0; i < acs.size(); ++i) {
          const double weight = weights == nullptr ? 1.0 : weights[i];
          if (internal::is_usable(acs[i]) && weight > 0.0) use(epipolar_rows(acs[i]), weight);
        }
      },
      kRankDeficient);
  if (!e) return {};
  return internal::with_sign(internal::pose_from_entries(*e), acs, weights,
                             internal::EpipolarRows::kAffine);
}

}  // namespace oneac
