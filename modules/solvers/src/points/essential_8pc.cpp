#include "oneac/solvers/essential_8pc.h"

#include "math/least_squares_null_vector.h"
#include "math/normalisation.h"
#include "math/null_space.h"

#include "oneac/geometry/essential.h"
#include "oneac/geometry/triangulation.h"

#include <Eigen/Dense>

namespace oneac {
namespace {

// Pivots below this share of the first: fewer than eight independent equations.
constexpr double kSingular = 1e-10;
// The same for the second eigenvalue of normal equations.
constexpr double kSingularGram = 1e-14;

using Row = Eigen::Matrix<double, 1, 9>;

[[nodiscard]] Row epipolar_row(const Eigen::Vector2d& x1, const Eigen::Vector2d& x2) {
  Row row;
  row << x2.x() * x1.x(), x2.x() * x1.y(), x2.x(), x2.y() * x1.x(), x2.y() * x1.y(), x2.y(), x1.x(),
      x1.y(), 1.0;
  return row;
}

[[nodiscard]] Eigen::Matrix3d unpack(const Eigen::Matrix<double, 9, 1>& e) {
  Eigen::Matrix3d E;
  E << e(0), e(1), e(2), e(3), e(4), e(5), e(6), e(7), e(8);
  return E;
}

/// The nearest matrix with singular values (s, s, 0), scaled to s = 1.
[[nodiscard]] SolutionSet<Eigen::Matrix3d, 1> nearest_essential(const Eigen::Matrix3d& M) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (!(svd.singularValues()(1) > 1e-9 * svd.singularValues()(0))) return {};
  const Eigen::Matrix3d E = svd.matrixU().leftCols<2>() * svd.matrixV().leftCols<2>().transpose();
  if (!E.allFinite()) return {};
  return E;
}

}  // namespace

SolutionSet<Eigen::Matrix3d, 1> essential_8pc(AcSpan points, const double* weights) {
  std::size_t used = 0;
  Eigen::Matrix<double, 8, 9> minimal;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!internal::takes_part(points, weights, i)) continue;
    if (used < 8) {
      minimal.row(static_cast<Eigen::Index>(used)) = epipolar_row(points[i].x1, points[i].x2);
    }
    ++used;
  }
  Eigen::Matrix<double, 9, 1> e;
  if (used < 8) return {};
  if (used == 8) {
    if (!internal::null_space<8, 9>(minimal, kSingular, e)) return {};
    return nearest_essential(unpack(e));
  }
  internal::Normalisation N1, N2;
  if (!internal::normalise(points, weights, &AffineCorrespondence::x1, N1) ||
      !internal::normalise(points, weights, &AffineCorrespondence::x2, N2)) {
    return {};
  }
  const auto normalised = internal::least_squares_null_vector<9>(
      [&](auto&& use) {
        for (std::size_t i = 0; i < points.size(); ++i) {
          if (!internal::takes_part(points, weights, i)) continue;
          use(epipolar_row(N1 * points[i].x1, N2 * points[i].x2),
              weights == nullptr ? 1.0 : weights[i]);
        }
      },
      kSingularGram);
  if (!normalised) return {};
  return nearest_essential(N2.matrix().transpose() * unpack(*normalised) * N1.matrix());
}

SolutionSet<RelativePose, 1> pose_from_essential(const Eigen::Matrix3d& E, AcSpan points) {
  if (!E.allFinite() || !(E.norm() > 0.0)) return {};
  const auto candidates = decompose_essential(E);
  int best = -1;
  int most = 0;
  for (int k = 0; k < 4; k += 2) {  // the second of each pair is the first with t flipped
    int before = 0, behind = 0;
    for (const AffineCorrespondence& ac : points) {
      if (!internal::has_points(ac)) continue;
      const int vote = cheirality(candidates[static_cast<std::size_t>(k)], ac.x1, ac.x2);
      before += vote > 0 ? 1 : 0;
      behind += vote < 0 ? 1 : 0;
    }
    if (before > most) most = before, best = k;
    if (behind > most) most = behind, best = k + 1;
  }
  if (best < 0) return {};
  return candidates[static_cast<std::size_t>(best)];
}

}  // namespace oneac
