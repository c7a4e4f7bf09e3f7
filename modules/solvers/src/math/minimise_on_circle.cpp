#include "math/minimise_on_circle.h"

#include <algorithm>
#include <cmath>

namespace oneac::internal {
namespace {

// Newton on the secular equation: its worst start seen in 10^7 random problems took ten steps, the
// rest is margin. It converges quadratically: after a step below this share the next one is
// rounding.
constexpr int kSecularSteps = 30;
constexpr double kSecularStep = 1e-9;

/// Unit eigenvector of the smaller eigenvalue; `gap` is the difference of the two.
[[nodiscard]] Eigen::Vector2d smaller_eigenvector(const Eigen::Matrix2d& Q, double& gap) {
  const double half_difference = 0.5 * (Q(0, 0) - Q(1, 1));
  const double radius = std::sqrt(half_difference * half_difference + Q(0, 1) * Q(0, 1));
  gap = 2.0 * radius;
  if (!(radius > 0.0)) return {1.0, 0.0};
  const double large = radius + std::abs(half_difference);  // no cancellation
  const double inverse = 1.0 / std::sqrt(gap * large);
  return half_difference > 0.0 ? Eigen::Vector2d(-Q(0, 1) * inverse, large * inverse)
                               : Eigen::Vector2d(large * inverse, -Q(0, 1) * inverse);
}

/// Root μ > 0 of (h1/μ)² + (h2/(μ + gap))² = 1: Newton on 1/|·| − 1, which is concave and
/// increasing, so that it converges monotonically from the left; one step from the right lands left
/// of the root.
[[nodiscard]] double secular_root(double h1, double h2, double gap, double start) {
  const double least = std::max({std::abs(h1), std::abs(h2) - gap, 1e-300});
  double mu = std::max(start, least);
  for (int step = 0; step < kSecularSteps; ++step) {
    const double inverse = 1.0 / (mu * (mu + gap));
    const double a = h1 * (mu + gap) * inverse;
    const double b = h2 * mu * inverse;
    const double f = a * a + b * b;
    const double slope = (a * a * (mu + gap) + b * b * mu) * inverse;
    const double next = std::max(mu + (std::sqrt(f) - 1.0) * f / slope, least);
    const double delta = std::abs(next - mu);
    mu = next;
    if (!(delta > kSecularStep * mu)) break;
  }
  return mu;
}

/// The minimum by the roots of the secular equation in the eigenbasis of Q.
[[nodiscard]] Eigen::Vector2d minimum(const Eigen::Matrix2d& Q, const Eigen::Vector2d& h) {
  double gap = 0.0;
  const Eigen::Vector2d v = smaller_eigenvector(Q, gap);
  const Eigen::Vector2d w(-v.y(), v.x());
  const double h1 = h.dot(v);
  const double h2 = h.dot(w);
  const double scale = std::abs(h1) + std::abs(h2) + gap;
  if (!(scale > 0.0)) return {1.0, 0.0};
  // Hard case: no right-hand side along v, and w alone stays inside the circle.
  if (std::abs(h1) <= 1e-15 * scale && std::abs(h2) < gap) {
    const double b = h2 / gap;
    const double a = std::sqrt(1.0 - b * b);
    const Eigen::Vector2d plus = a * v + b * w;
    const Eigen::Vector2d minus = -a * v + b * w;
    return plus.x() >= minus.x() ? plus : minus;  // a tie: the smaller turn
  }
  // Without noise the unconstrained minimum lies on the circle: λ = 0, μ = λ + low.
  const double low = 0.5 * (Q.trace() - gap);
  const double mu = secular_root(h1, h2, gap, low);
  const double a = h1 * (mu + gap);
  const double b = h2 * mu;
  return (a * v + b * w) / std::sqrt(a * a + b * b);
}

}  // namespace

Eigen::Vector2d minimise_on_circle(const Eigen::Matrix2d& Q, const Eigen::Vector2d& h) {
  const CircleProblem problem{Q(0, 0), Q(0, 1), Q(1, 1), h.x(), h.y()};
  Eigen::Vector2d z;
  if (!minimise_near_circle(problem, z.x(), z.y())) {
    minimise_far_from_circle(problem, z.x(), z.y());
  }
  return z;
}

void minimise_far_from_circle(const CircleProblem& problem, double& c, double& s) {
  Eigen::Matrix2d Q;
  Q << problem.cc, problem.cs, problem.cs, problem.ss;
  const Eigen::Vector2d z = minimum(Q, {problem.cb, problem.sb});
  c = z.x();
  s = z.y();
}

}  // namespace oneac::internal
