#include "oneac/solvers/homography_2ac.h"

#include "math/least_squares_null_vector.h"
#include "math/normalisation.h"
#include "points/homography_scale.h"

#include <Eigen/Dense>

#include <cmath>

namespace oneac {
namespace {

// Second eigenvalue below this share of the largest: the correspondences do not determine H.
constexpr double kSingular = 1e-15;
// |y| [-] that is the horizon of a level camera to rounding.
constexpr double kOnHorizon = 1e-12;

using Vector9 = Eigen::Matrix<double, 9, 1>;

/// eqs. (4) and (5), unknowns h1 … h9.
[[nodiscard]] Eigen::Matrix<double, 6, 9> rows_of(const Eigen::Vector2d& x1,
                                                  const Eigen::Vector2d& x2,
                                                  const Eigen::Matrix2d& A) {
  const double x = x1.x(), y = x1.y(), u = x2.x(), v = x2.y();
  const double a1 = A(0, 0), a2 = A(0, 1), a3 = A(1, 0), a4 = A(1, 1);
  Eigen::Matrix<double, 6, 9> m;
  m << x, y, 1, 0, 0, 0, -u * x, -u * y, -u,          //
      0, 0, 0, x, y, 1, -v * x, -v * y, -v,           //
      1, 0, 0, 0, 0, 0, -(u + a1 * x), -a1 * y, -a1,  //
      0, 1, 0, 0, 0, 0, -a2 * x, -(u + a2 * y), -a2,  //
      0, 0, 0, 1, 0, 0, -(v + a3 * x), -a3 * y, -a3,  //
      0, 0, 0, 0, 1, 0, -a4 * x, -(v + a4 * y), -a4;
  return m;
}

[[nodiscard]] bool is_used(AcSpan acs, const double* weights, std::size_t i) {
  return internal::takes_part(acs, weights, i) && internal::is_usable(acs[i]);
}

/// Two or more correspondences, not all of them on the horizon. What lies there would determine H
/// as well as any; it is refused because every solver of this module refuses it.
[[nodiscard]] bool are_enough(AcSpan acs, const double* weights) {
  std::size_t used = 0;
  bool below_or_above = false;
  for (std::size_t i = 0; i < acs.size(); ++i) {
    if (!is_used(acs, weights, i)) continue;
    ++used;
    below_or_above = below_or_above || std::abs(acs[i].x1.y()) > kOnHorizon;
  }
  return used >= 2 && below_or_above;
}

}  // namespace

SolutionSet<Eigen::Matrix3d, 1> homography_2ac(AcSpan acs, const double* weights) {
  internal::Normalisation N1, N2;
  if (acs.size() < 2 || !internal::normalise(acs, weights, &AffineCorrespondence::x1, N1) ||
      !internal::normalise(acs, weights, &AffineCorrespondence::x2, N2)) {
    return {};
  }
  if (!are_enough(acs, weights)) return {};
  const auto found = internal::least_squares_null_vector<9>(
      [&](auto&& use) {
        for (std::size_t i = 0; i < acs.size(); ++i) {
          if (!is_used(acs, weights, i)) continue;
          use(rows_of(N1 * acs[i].x1, N2 * acs[i].x2, (N2.s / N1.s) * acs[i].A),
              weights == nullptr ? 1.0 : weights[i]);
        }
      },
      kSingular);
  if (!found) return {};
  const Vector9& h = *found;
  Eigen::Matrix3d H;
  H << h(0), h(1), h(2), h(3), h(4), h(5), h(6), h(7), h(8);
  return internal::scaled_homography(N2.inverse_matrix() * H * N1.matrix(), acs, weights);
}

}  // namespace oneac
