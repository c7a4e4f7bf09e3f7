#include "oneac/geometry/robust_loss.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oneac {
namespace {

constexpr double kSquaredScale = 2.25;

double geman_mcclure(double r2) {
  return r2 / (1.0 + r2 / kSquaredScale);
}

double cauchy(double r2) {
  return kSquaredScale * std::log1p(r2 / kSquaredScale);
}

template <class Loss>
double slope(Loss&& loss, double r2) {
  constexpr double kStep = 1e-6;
  return (loss(r2 + kStep) - loss(r2 - kStep)) / (2.0 * kStep);
}

TEST(RobustLoss, WeightsAreTheSlopesOfTheirLosses) {
  for (const double r2 : {0.0, 0.1, 1.0, 9.0, 400.0}) {
    EXPECT_NEAR(geman_mcclure_weight(r2, kSquaredScale), slope(geman_mcclure, r2), 1e-8) << r2;
    EXPECT_NEAR(cauchy_weight(r2, kSquaredScale), slope(cauchy, r2), 1e-8) << r2;
  }
}

TEST(RobustLoss, DivisorIsTheWeightsReciprocal) {
  for (const double r2 : {0.0, 0.1, 1.0, 9.0, 400.0}) {
    EXPECT_NEAR(geman_mcclure_weight(r2, kSquaredScale) * geman_mcclure_divisor(r2, kSquaredScale),
                1.0, 1e-14);
  }
}

}  // namespace
}  // namespace oneac
