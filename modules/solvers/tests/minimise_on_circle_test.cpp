#include "math/minimise_on_circle.h"

#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace oneac::internal {
namespace {

double value(const Eigen::Matrix2d& Q, const Eigen::Vector2d& h, const Eigen::Vector2d& z) {
  return z.dot(Q * z) - 2.0 * h.dot(z);
}

/// Least value over the angle: every local minimum of a grid, refined (two may be nearly equal).
double brute_force(const Eigen::Matrix2d& Q, const Eigen::Vector2d& h) {
  const auto at = [&](double a) { return value(Q, h, {std::cos(a), std::sin(a)}); };
  constexpr double kStep = 5e-4;
  double least = at(0.0);
  double a = 0.0;
  while (a < 6.2832) {
    if (at(a) <= at(a - kStep) && at(a) <= at(a + kStep)) {
      double best = a, step = kStep;
      while (step > 1e-9) {
        if (at(best + step) < at(best)) best += step;
        if (at(best - step) < at(best)) best -= step;
        step *= 0.6;
      }
      least = std::min(least, at(best));
    }
    a += kStep;
  }
  return least;
}

Eigen::Matrix2d symmetric(double low, double high, double angle) {
  Eigen::Matrix2d V;
  V << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return V * Eigen::Vector2d(low, high).asDiagonal() * V.transpose();
}

TEST(MinimiseOnCircle, EqualsBruteForceOnRandomProblems) {
  SceneGenerator scene(1);
  for (int i = 0; i < 300; ++i) {
    const double low = scene.uniform(0.0, 2.0);
    const Eigen::Matrix2d Q =
        symmetric(low, low + scene.uniform(0.0, 3.0), scene.uniform(-3.2, 3.2));
    const Eigen::Vector2d h(scene.uniform(-2, 2), scene.uniform(-2, 2));
    const Eigen::Vector2d z = minimise_on_circle(Q, h);
    EXPECT_NEAR(z.norm(), 1.0, 1e-14);
    EXPECT_NEAR(value(Q, h, z), brute_force(Q, h), 1e-9) << "case " << i << " of seed 1";
  }
}

TEST(MinimiseOnCircle, SolvesTheHardCaseAndItsNeighbourhood) {
  SceneGenerator scene(2);
  for (int i = 0; i < 300; ++i) {
    const double angle = scene.uniform(-3.2, 3.2);
    const Eigen::Matrix2d Q = symmetric(0.5, 2.5, angle);
    const Eigen::Vector2d v(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d w(-v.y(), v.x());
    // h along w alone, |h·w| below and above the gap of 2, with and without a trace of v.
    const double trace = i % 3 == 0 ? 0.0 : std::pow(10.0, scene.uniform(-18, -6));
    const Eigen::Vector2d h = scene.uniform(-2.5, 2.5) * w + trace * v;
    const Eigen::Vector2d z = minimise_on_circle(Q, h);
    EXPECT_NEAR(z.norm(), 1.0, 1e-14);
    EXPECT_NEAR(value(Q, h, z), brute_force(Q, h), 1e-9) << "case " << i << " of seed 2";
  }
}

TEST(MinimiseOnCircle, HandlesEqualEigenvaluesAndNoRightHandSide) {
  const Eigen::Vector2d h(-0.3, 0.4);
  EXPECT_LT((minimise_on_circle(2.0 * Eigen::Matrix2d::Identity(), h) - h / 0.5).norm(), 1e-14);
  Eigen::Vector2d far;
  minimise_far_from_circle({2.0, 0.0, 2.0, h.x(), h.y()}, far.x(), far.y());
  EXPECT_LT((far - h / 0.5).norm(), 1e-14);
  EXPECT_NEAR(minimise_on_circle(Eigen::Matrix2d::Zero(), Eigen::Vector2d::Zero()).norm(), 1.0,
              1e-15);
  const Eigen::Matrix2d Q = symmetric(1.0, 3.0, 0.4);
  const Eigen::Vector2d z = minimise_on_circle(Q, Eigen::Vector2d::Zero());
  EXPECT_NEAR(value(Q, Eigen::Vector2d::Zero(), z), 1.0, 1e-12);
  EXPECT_GT(z.x(), 0.0);  // of the two, the smaller turn
}

}  // namespace
}  // namespace oneac::internal
