#include "one_ac/upright_half_angles.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <utility>

namespace oneac::internal {
namespace {

// Newton on the cubic takes five steps in the mean.
constexpr int kCubicSteps = 20;
constexpr double kCubicStep = 1e-12;
// A negative discriminant of this share is the rounding of a double root.
constexpr double kDoubleRoot = 1e-12;
// On the quartic itself: the pencil's roots have lost a few digits, where roots are close some
// more.
constexpr int kPolishSteps = 2;
constexpr double kPolishReach = 1e-3;  // a longer step would go to another root

/// One real root of x³ + b x² + c x + d. About the inflection it is h³ − (b² − 3 c) h / 3 + f: the
/// start lies beyond the outermost root, from where Newton comes down monotonously.
[[nodiscard]] double monic_cubic_root(double b, double c, double d) {
  const double inflection = -b / 3.0;
  const auto value = [&](double x) { return d + x * (c + x * (b + x)); };
  const double f = value(inflection);
  const double beyond = std::cbrt(std::abs(f)) + std::sqrt(std::max(b * b / 9.0 - c / 3.0, 0.0));
  double x = inflection - std::copysign(beyond, f);
  for (int step = 0; step < kCubicSteps; ++step) {
    const double slope = c + x * (2.0 * b + 3.0 * x);
    const double delta = value(x) / slope;
    if (!std::isfinite(delta)) break;
    x -= delta;
    if (std::abs(delta) <= kCubicStep * std::abs(x)) break;
  }
  return x;
}

/// A pair (λ, κ) with det(λ C1 + κ C0) = c3 λ³ + c2 λ² κ + c1 λ κ² + c0 κ³ = 0.
[[nodiscard]] std::pair<double, double> pencil_root(double c3, double c2, double c1, double c0) {
  if (std::abs(c3) >= std::abs(c0)) {
    if (!(std::abs(c3) > 0.0)) return {0.0, 1.0};
    return {monic_cubic_root(c2 / c3, c1 / c3, c0 / c3), 1.0};
  }
  return {1.0, monic_cubic_root(c1 / c0, c2 / c0, c3 / c0)};
}

/// The two lines of a conic of rank two, or one; none when they are complex.
[[nodiscard]] SolutionSet<Eigen::Vector3d, 2> lines_of(const Eigen::Matrix3d& C) {
  Eigen::Matrix3d B;  // minus the cofactors
  for (int i = 0; i < 3; ++i) B.row(i) = C.row((i + 2) % 3).cross(C.row((i + 1) % 3));
  Eigen::Index k = 0;
  B.diagonal().maxCoeff(&k);
  if (!(B(k, k) > 0.0)) return {};
  const Eigen::Vector3d p = B.col(k) / std::sqrt(B(k, k));
  Eigen::Matrix3d N = C;
  N(0, 1) -= p.z(), N(1, 0) += p.z();
  N(0, 2) += p.y(), N(2, 0) -= p.y();
  N(1, 2) -= p.x(), N(2, 1) += p.x();
  Eigen::Index row = 0, column = 0;
  N.cwiseAbs().maxCoeff(&row, &column);
  SolutionSet<Eigen::Vector3d, 2> lines;
  lines.push_back(N.row(row).transpose());
  lines.push_back(N.col(column));
  return lines;
}

/// Appends the real roots of a x² + 2 h x + c.
void add_roots(double a, double h, double c, SolutionSet<double, 4>& roots) {
  double discriminant = h * h - a * c;
  const double size = h * h + std::abs(a * c);
  if (discriminant < 0.0) {
    if (!(discriminant > -kDoubleRoot * size)) return;
    discriminant = 0.0;
  }
  const double q = -(h + std::copysign(std::sqrt(discriminant), h));
  const double large = q / a, small = c / q;
  if (std::isfinite(small)) roots.push_back(small);
  if (std::isfinite(large)) roots.push_back(large);
}

/// Newton on the quartic p, coefficients ascending.
[[nodiscard]] double polished(const double (&p)[5], double x) {
  for (int step = 0; step < kPolishSteps; ++step) {
    const double v = p[0] + x * (p[1] + x * (p[2] + x * (p[3] + x * p[4])));
    const double d = p[1] + x * (2.0 * p[2] + x * (3.0 * p[3] + x * 4.0 * p[4]));
    const double delta = v / d;
    if (!(std::abs(delta) < kPolishReach * (1.0 + std::abs(x)))) break;
    x -= delta;
  }
  return x;
}

}  // namespace

SolutionSet<double, 4> upright_half_angles(const AheadCorrespondence& ac) {
  const double sum = ac.v + ac.y, difference = ac.v - ac.y, k = sum * difference;
  const double determinant = ac.a1 * ac.a4 - ac.a2 * ac.a3;
  const auto [lambda, kappa] =
      pencil_root(k, -2.0 * ac.a3, (ac.a4 - ac.a1) * (ac.a4 + ac.a1) + k * ac.a2 * ac.a2,
                  2.0 * ac.a2 * determinant);
  Eigen::Matrix3d C;
  C << -lambda, kappa * ac.a2, kappa * ac.a1,  //
      kappa * ac.a2, lambda, kappa * ac.a4,    //
      kappa * ac.a1, kappa * ac.a4, 2.0 * kappa * ac.a3 - lambda * k;
  const double p[5] = {ac.a2 * difference * difference, 2.0 * difference * (ac.a1 - ac.a4),
                       -4.0 * ac.a3, -2.0 * sum * (ac.a1 + ac.a4), -ac.a2 * sum * sum};
  SolutionSet<double, 4> roots;
  for (const Eigen::Vector3d& line : lines_of(C)) {
    add_roots((line.x() + line.y()) * sum, line.z(), (line.y() - line.x()) * difference, roots);
  }
  for (std::size_t i = 0; i < roots.size(); ++i) roots[i] = polished(p, roots[i]);
  return roots;
}

}  // namespace oneac::internal
