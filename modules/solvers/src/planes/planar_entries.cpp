#include "planes/planar_entries.h"

#include "math/epipolar_rows.h"
#include "math/least_squares_null_vector.h"
#include "math/thresholds.h"

#include "oneac/geometry/triangulation.h"

#include <cmath>

namespace oneac::internal {
namespace {

using Rows = Eigen::Matrix<double, 3, 4>;

// The second eigenvalue of the normal matrix below this share of the largest: not determined.
constexpr double kRankDeficient = 1e-12;

/// Epipolar row and the two affine-epipolar rows, unknowns (E12, E21, E23, E32).
[[nodiscard]] Rows planar_rows(const AffineCorrespondence& ac) {
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

[[nodiscard]] PlanarPose flipped(const PlanarPose& pose) {
  return {pose.cos_alpha, pose.sin_alpha, -pose.tx, -pose.tz};
}

}  // namespace

std::optional<Eigen::Vector4d> entries_of(const AffineCorrespondence& ac) {
  const Rows rows = planar_rows(ac);
  const Eigen::Vector4d e = null_vector(rows);
  const double lengths = rows.row(0).norm() * rows.row(1).norm() * rows.row(2).norm();
  if (!(e.norm() > kParallelRows * lengths)) return std::nullopt;
  return e;
}

std::optional<Eigen::Vector4d> entries_of(AcSpan acs, const double* weights) {
  return least_squares_null_vector<4>(
      [&](auto&& use) {
        for (std::size_t i = 0; i < acs.size(); ++i) {
          if (!counts(acs, weights, i)) continue;
          use(planar_rows(acs[i]), weights == nullptr ? 1.0 : weights[i]);
        }
      },
      kRankDeficient);
}

std::optional<PlanarPose> pose_from_entries(const Eigen::Vector4d& e) {
  const double squared = e(0) * e(0) + e(3) * e(3);
  if (!(squared > 1e-24 * e.squaredNorm())) return std::nullopt;
  const double length = std::sqrt(squared);
  const double tx = e(3) / length;
  const double tz = -e(0) / length;
  const double c = tz * e(1) - tx * e(2);
  const double s = -tx * e(1) - tz * e(2);
  const double norm = std::hypot(c, s);
  if (!(norm > 1e-12 * length) || !std::isfinite(norm)) return std::nullopt;
  return PlanarPose{c / norm, s / norm, tx, tz};
}

SolutionSet<PlanarPose, 1> with_sign(const std::optional<PlanarPose>& pose, AcSpan acs,
                                     const double* weights, EpipolarRows rows) {
  if (!pose) return {};
  int votes = 0;
  int voters = 0;
  const RelativePose T = pose->pose();
  for (std::size_t i = 0; i < acs.size(); ++i) {
    const bool usable = rows == EpipolarRows::kAffine ? is_usable(acs[i]) : has_points(acs[i]);
    if (!usable || (weights != nullptr && !(weights[i] > 0.0))) continue;
    const int vote = cheirality(T, acs[i].x1, acs[i].x2);
    votes += vote;
    voters += std::abs(vote);
  }
  if (voters == 0) return {};
  return votes >= 0 ? *pose : flipped(*pose);
}

}  // namespace oneac::internal
