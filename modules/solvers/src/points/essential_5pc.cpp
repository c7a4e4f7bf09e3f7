#include "oneac/solvers/essential_5pc.h"

#include "math/null_space.h"
#include "math/usable.h"
#include "points/five_point_basis.h"
#include "points/five_point_polish.h"
#include "points/five_point_roots.h"
#include "points/five_rays.h"

#include "oneac/geometry/essential.h"

#include <Eigen/Dense>

#include <cmath>

namespace oneac {
namespace {

// Pivots below this share of the first: fewer than five independent equations.
constexpr double kSingular = 1e-10;
// Cosines of ray angles closer than this are equal: no parallax [-].
constexpr double kSameAngle = 1e-10;

using Eigen::Matrix3d;
using internal::Basis;

/// Whether all angles between rays are the same in both views: the camera only turned, and every t
/// fits.
[[nodiscard]] bool is_pure_rotation(const internal::FiveRays& rays) {
  const auto& [r1, r2] = rays;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < i; ++j) {
      if (std::abs(r1[i].dot(r1[j]) - r2[i].dot(r2[j])) > kSameAngle) return false;
    }
  }
  return true;
}

}  // namespace

SolutionSet<Matrix3d, 10> essential_5pc(AcSpan points) {
  SolutionSet<Matrix3d, 10> solutions;
  if (points.size() < 5) return solutions;
  Eigen::Matrix<double, 5, 9> rows;
  for (std::size_t i = 0; i < 5; ++i) {
    if (!internal::has_points(points[i])) return solutions;
    const double x = points[i].x1.x(), y = points[i].x1.y();
    const double u = points[i].x2.x(), v = points[i].x2.y();
    rows.row(static_cast<Eigen::Index>(i)) << u * x, u * y, u, v * x, v * y, v, x, y, 1.0;
  }
  const internal::FiveRays rays(points);
  if (is_pure_rotation(rays)) return solutions;
  Basis basis;
  if (!internal::null_space<5, 9>(rows, kSingular, basis)) return solutions;
  basis = internal::well_scaled(basis, rays);
  for (const Matrix3d& E : internal::essentials_of(basis)) {
    auto T = internal::motion_near(E);
    if (T && internal::polish_on_five_points(points, *T)) solutions.push_back(essential_matrix(*T));
  }
  return solutions;
}

}  // namespace oneac
