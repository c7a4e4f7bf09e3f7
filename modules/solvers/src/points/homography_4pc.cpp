#include "oneac/solvers/homography_4pc.h"

#include "math/least_squares_null_vector.h"
#include "math/normalisation.h"
#include "math/null_space.h"
#include "points/homography_scale.h"

#include <Eigen/Dense>

namespace oneac {
namespace {

// Pivots (and second eigenvalues) below this share of the largest: the points do not determine H.
constexpr double kSingular = 1e-9;

using Rows = Eigen::Matrix<double, 2, 9>;

/// eq. (4) for one normalised point, unknowns h1 … h9.
[[nodiscard]] Rows point_rows(const Eigen::Vector2d& x1, const Eigen::Vector2d& x2) {
  const double x = x1.x(), y = x1.y(), u = x2.x(), v = x2.y();
  Rows rows;
  rows << x, y, 1.0, 0.0, 0.0, 0.0, -u * x, -u * y, -u,  //
      0.0, 0.0, 0.0, x, y, 1.0, -v * x, -v * y, -v;
  return rows;
}

[[nodiscard]] Eigen::Matrix3d unpack(const Eigen::Matrix<double, 9, 1>& h) {
  Eigen::Matrix3d H;
  H << h(0), h(1), h(2), h(3), h(4), h(5), h(6), h(7), h(8);
  return H;
}

}  // namespace

SolutionSet<Eigen::Matrix3d, 1> homography_4pc(AcSpan points, const double* weights) {
  internal::Normalisation N1, N2;
  if (points.size() < 4 || !internal::normalise(points, weights, &AffineCorrespondence::x1, N1) ||
      !internal::normalise(points, weights, &AffineCorrespondence::x2, N2)) {
    return {};
  }
  std::size_t used = 0;
  const auto for_each_point = [&](auto&& use) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!internal::takes_part(points, weights, i)) continue;
      use(point_rows(N1 * points[i].x1, N2 * points[i].x2), weights == nullptr ? 1.0 : weights[i]);
    }
  };
  Eigen::Matrix<double, 8, 9> minimal;
  for_each_point([&](const Rows& rows, double) {
    if (used < 4) minimal.middleRows<2>(static_cast<Eigen::Index>(2 * used)) = rows;
    ++used;
  });
  if (used < 4) return {};
  Eigen::Matrix<double, 9, 1> h;
  if (used == 4) {
    if (!internal::null_space<8, 9>(minimal, kSingular, h)) return {};
  } else {
    const auto many = internal::least_squares_null_vector<9>(for_each_point, kSingular * kSingular);
    if (!many) return {};
    h = *many;
  }
  return internal::scaled_homography(N2.inverse_matrix() * unpack(h) * N1.matrix(), points,
                                     weights);
}

}  // namespace oneac
