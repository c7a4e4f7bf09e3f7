#include "oneac/geometry/angles.h"
#include "oneac/geometry/triangulation.h"
#include "oneac/solvers/registry.h"
#include "oneac/study/method.h"

#include <Eigen/Dense>

#include <cmath>

namespace oneac {
namespace {

// The cost is a quadratic form of two unit vectors: its valleys are wider than the grid's steps.
constexpr int kGrid = 36;
constexpr int kSteps = 30;

using Entries = Eigen::Vector4d;  // E12, E21, E23, E32

[[nodiscard]] Eigen::Matrix<double, 3, 4> rows_of(const AffineCorrespondence& ac) {
  const double x = ac.x1.x(), y = ac.x1.y(), u = ac.x2.x(), v = ac.x2.y();
  Eigen::Matrix<double, 3, 4> rows;
  rows << u * y, v * x, v, y,                               //
      ac.A(0, 0) * y, ac.A(1, 0) * x + v, ac.A(1, 0), 0.0,  //
      ac.A(0, 1) * y + u, ac.A(1, 1) * x, ac.A(1, 1), 1.0;
  return rows;
}

/// Heading of t, and heading plus yaw.
struct Angles {
  double heading, sum;

  [[nodiscard]] Entries entries() const {
    return {-std::cos(heading), std::cos(sum), -std::sin(sum), std::sin(heading)};
  }
  [[nodiscard]] Eigen::Matrix<double, 4, 2> derivatives() const {
    Eigen::Matrix<double, 4, 2> J;
    J << std::sin(heading), 0.0, 0.0, -std::sin(sum), 0.0, -std::cos(sum), std::cos(heading), 0.0;
    return J;
  }
  [[nodiscard]] RelativePose pose() const {
    const double yaw = sum - heading;
    return {yaw_rotation(std::cos(yaw), std::sin(yaw)),
            {std::sin(heading), 0.0, std::cos(heading)}};
  }
};

[[nodiscard]] double cost(const Eigen::Matrix4d& G, const Angles& a) {
  return a.entries().dot(G * a.entries());
}

/// −e costs what e does: half of one circle is enough.
[[nodiscard]] Angles best_of_grid(const Eigen::Matrix4d& G) {
  Angles best{0.0, 0.0};
  for (int i = 0; i < kGrid / 2; ++i) {
    for (int k = 0; k < kGrid; ++k) {
      const Angles here{2.0 * kPi * i / kGrid, 2.0 * kPi * k / kGrid};
      if (cost(G, here) < cost(G, best)) best = here;
    }
  }
  return best;
}

[[nodiscard]] Angles descended(const Eigen::Matrix4d& G, Angles a) {
  double damping = 1e-6;
  for (int step = 0; step < kSteps; ++step) {
    const auto J = a.derivatives();
    Eigen::Matrix2d N = J.transpose() * G * J;
    N.diagonal() *= 1.0 + damping;
    const Eigen::Vector2d delta = N.inverse() * (J.transpose() * (G * a.entries()));
    const Angles next{a.heading - delta.x(), a.sum - delta.y()};
    const bool better = cost(G, next) <= cost(G, a);
    if (better) a = next;
    damping = better ? 0.1 * damping : 10.0 * damping + 1e-9;
  }
  return a;
}

PoseSet solve(AcSpan acs) {
  Eigen::Matrix4d G = Eigen::Matrix4d::Zero();
  for (const AffineCorrespondence& ac : acs) G += rows_of(ac).transpose() * rows_of(ac);
  if (!G.allFinite()) return {};
  RelativePose T = descended(G, best_of_grid(G)).pose();
  int votes = 0;
  for (const AffineCorrespondence& ac : acs) votes += cheirality(T, ac.x1, ac.x2);
  if (votes < 0) T.t = -T.t;
  return PlanePose{T, Eigen::Vector3d::UnitY()};
}

}  // namespace

StudyMethod planar_two_circles() {
  static const Solver kRival = [] {
    Solver rival = solver_named("relpose_1ac_planar");
    rival.name = "planar_two_circles";
    rival.label = "two circles";
    rival.method = "";
    rival.run.least_squares = &solve;
    return rival;
  }();
  return &kRival;
}

}  // namespace oneac
