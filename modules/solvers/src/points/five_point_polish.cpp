#include "points/five_point_polish.h"

#include "planes/small_rotation.h"

#include "oneac/geometry/tangent_basis.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace oneac::internal {
namespace {

// Roots of a good elimination need two or three steps, those near a double root converge linearly.
constexpr int kSteps = 10;
constexpr double kExact = 4e-16;  // epipolar residual that is rounding
constexpr double kConverged =
    1e-14;                           // below it a step that does not halve the residual is the last
constexpr double kAccepted = 1e-13;  // residual above which a root was none
// Newton–Schulz squares the distance from orthonormal: 1e-4 becomes 1e-16 in two approaches, 0.9 in
// eight. What is no rotation then came from a matrix that is not essential.
constexpr int kApproaches = 2;
constexpr int kMostApproaches = 8;
constexpr double kOrthonormal = 1e-12;
// A step is at most this long [rad]: what asks for more is no neighbour.
constexpr double kLongestStep = 1.0;

using Tangents = Eigen::Matrix<double, 3, 2>;

/// Solves the five equations in place, rows (a | b); the solution is in the last column.
[[nodiscard]] bool solve(double (&m)[5][6]) {
  for (int k = 0; k < 5; ++k) {
    int pivot = k;
    for (int i = k + 1; i < 5; ++i) {
      if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
    }
    if (!(std::abs(m[pivot][k]) > 0.0)) return false;
    if (pivot != k) std::swap(m[pivot], m[k]);
    const double inverse = 1.0 / m[k][k];
    for (int i = k + 1; i < 5; ++i) {
      const double factor = m[i][k] * inverse;
      for (int j = k + 1; j < 6; ++j) m[i][j] -= factor * m[k][j];
    }
  }
  for (int k = 4; k >= 0; --k) {
    for (int j = k + 1; j < 5; ++j) m[k][5] -= m[k][j] * m[j][5];
    m[k][5] /= m[k][k];
  }
  return true;
}

/// Rows of the Newton step (rotation vector, shift of t along the tangents | −residual). Returns
/// the largest residual.
[[nodiscard]] double linearise(AcSpan points, const RelativePose& T, const Tangents& tangents,
                               double (&m)[5][6]) {
  double largest = 0.0;
  for (std::size_t i = 0; i < 5; ++i) {
    const Eigen::Vector3d a = T.R * points[i].x1.homogeneous();
    const Eigen::Vector3d x2 = points[i].x2.homogeneous();
    const Eigen::Vector3d n = a.cross(x2);  // x2ᵀ [t]× a = t · n
    const Eigen::Vector3d w = a.cross(x2.cross(T.t));
    const double residual = T.t.dot(n);
    const double row[6] = {w.x(),    w.y(), w.z(), tangents.col(0).dot(n), tangents.col(1).dot(n),
                           -residual};
    std::copy(row, row + 6, m[i]);
    largest = std::max(largest, std::abs(residual));
  }
  return largest;
}

[[nodiscard]] bool is_finite(const double (&m)[5][6]) {
  return std::all_of(m, m + 5, [](const double(&row)[6]) { return std::isfinite(row[5]); });
}

/// False for what is not finite, too.
[[nodiscard]] bool is_identity(const Eigen::Matrix3d& M) {
  return (M - Eigen::Matrix3d::Identity()).squaredNorm() < kOrthonormal * kOrthonormal;
}

[[nodiscard]] Eigen::Vector3d at_most(double length, const Eigen::Vector3d& step) {
  const double norm = step.norm();
  return norm > length ? Eigen::Vector3d(step * (length / norm)) : step;
}

}  // namespace

std::optional<RelativePose> motion_near(const Eigen::Matrix3d& E) {
  Eigen::Matrix3d cofactors;
  for (int i = 0; i < 3; ++i) cofactors.row(i) = E.row((i + 1) % 3).cross(E.row((i + 2) % 3));
  const Eigen::Matrix3d ttT =
      0.5 * E.squaredNorm() * Eigen::Matrix3d::Identity() - E * E.transpose();
  Eigen::Index largest = 0;
  ttT.diagonal().maxCoeff(&largest);
  RelativePose T;
  T.t = ttT.col(largest).normalized();
  T.R = (2.0 / E.squaredNorm()) * cofactors -
        std::sqrt(2.0 / E.squaredNorm()) * cross_matrix(T.t) * E;
  for (int i = 0; i <= kMostApproaches; ++i) {
    const Eigen::Matrix3d RtR = T.R.transpose() * T.R;
    if (i >= kApproaches && is_identity(RtR)) return T;
    T.R = 0.5 * T.R * (3.0 * Eigen::Matrix3d::Identity() - RtR);
  }
  return std::nullopt;
}

bool polish_on_five_points(AcSpan points, RelativePose& T) {
  double before = 0.0;
  for (int step = 0; T.is_finite(); ++step) {
    const Tangents tangents = tangent_basis(T.t);
    double m[5][6];
    const double residual = linearise(points, T, tangents, m);
    const bool stagnates = step > 0 && residual < kConverged && residual > 0.5 * before;
    if (residual < kExact || stagnates || step == kSteps) return residual < kAccepted;
    before = residual;
    if (!solve(m) || !is_finite(m)) return false;
    T.R = small_rotation(at_most(kLongestStep, {m[0][5], m[1][5], m[2][5]})) * T.R;
    const Eigen::Vector3d shift = m[3][5] * tangents.col(0) + m[4][5] * tangents.col(1);
    T.t = (T.t + at_most(kLongestStep, shift)).normalized();
  }
  return false;
}

}  // namespace oneac::internal
