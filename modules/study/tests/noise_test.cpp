#include "oneac/study/noise.h"

#include "oneac/geometry/angles.h"
#include "oneac/geometry/homography.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

constexpr int kDraws = 20000;

Eigen::Matrix2d some_affinity() {
  Eigen::Matrix2d A;
  A << 1.3, 0.2, -0.1, 0.8;
  return A;
}

Eigen::Matrix3d some_homography() {
  Eigen::Matrix3d H;
  H << 1.0, 0.02, 0.05, -0.01, 1.1, 0.0, 0.03, -0.1, 0.95;
  return H;
}

double wrapped(double angle) {
  return std::remainder(angle, kPi);
}

/// What was done to the factors of A: the errors of both angles [rad] and of both singular values.
struct Errors {
  double first, second, large, small;
};

Errors errors_between(const Eigen::Matrix2d& A, const Eigen::Matrix2d& noisy) {
  const AffinityFactors before = affinity_factors(A), after = affinity_factors(noisy);
  return {wrapped(after.first - before.first), wrapped(after.second - before.second),
          after.large / before.large - 1.0, after.small / before.small - 1.0};
}

TEST(Noise, FactorsMultiplyBackAndAreThoseOfTheSvd) {
  TrialRandom random(5);
  for (int i = 0; i < 1000; ++i) {
    Eigen::Matrix2d A;
    for (double& entry : A.reshaped()) entry = random.uniform(-2.0, 2.0);
    const AffinityFactors factors = affinity_factors(A);
    EXPECT_LT((factors.matrix() - A).norm(), 1e-13);
    const Eigen::Vector2d values = A.jacobiSvd().singularValues();
    EXPECT_NEAR(factors.large, values(0), 1e-13);
    EXPECT_NEAR(std::abs(factors.small), values(1), 1e-13);
    EXPECT_EQ(factors.small < 0.0, A.determinant() < 0.0);
  }
}

TEST(Noise, ZeroLevelChangesNothing) {
  for (const NoiseShape shape :
       {NoiseShape::kUniform, NoiseShape::kFixed, NoiseShape::kNormal, NoiseShape::kCommon}) {
    TrialRandom random(7);
    const Eigen::Vector2d x1(0.2, 0.3);
    const AffineCorrespondence ac = noisy_correspondence(some_homography(), x1, {}, shape, random);
    EXPECT_LT(homography_residual(some_homography(), ac).norm(), 1e-14);
  }
}

TEST(Noise, FixedErrorsAreExactlyTheLevelAndEitherSign) {
  TrialRandom random(11);
  int positive = 0;
  for (int i = 0; i < kDraws; ++i) {
    const Errors e = errors_between(
        some_affinity(),
        noisy_affinity(some_affinity(), {0.0, 5.0, 5.0}, NoiseShape::kFixed, random));
    EXPECT_NEAR(std::abs(e.first), 5.0 * kDegree, 1e-12);
    EXPECT_NEAR(std::abs(e.second), 5.0 * kDegree, 1e-12);
    EXPECT_NEAR(std::abs(e.large), 0.05, 1e-12);
    EXPECT_NEAR(std::abs(e.small), 0.05, 1e-12);
    positive += e.first * e.second > 0.0 ? 1 : 0;  // signs of their own
  }
  EXPECT_NEAR(positive, kDraws / 2.0, 4 * std::sqrt(kDraws / 4.0));
}

TEST(Noise, UniformErrorsFillTheLevelAndAreIndependent) {
  TrialRandom random(13);
  double sum = 0.0, squares = 0.0, product = 0.0, most = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const Errors e = errors_between(
        some_affinity(),
        noisy_affinity(some_affinity(), {0.0, 2.0, 3.0}, NoiseShape::kUniform, random));
    const double share = e.first / (2.0 * kDegree);
    sum += share;
    squares += share * share;
    product += e.first * e.second;
    most = std::max({most, std::abs(share), std::abs(e.large) / 0.03, std::abs(e.small) / 0.03});
  }
  EXPECT_LE(most, 1.0 + 1e-9);
  EXPECT_GT(most, 0.99);
  EXPECT_NEAR(sum / kDraws, 0.0, 0.02);
  EXPECT_NEAR(squares / kDraws, 1.0 / 3.0, 0.01);
  EXPECT_NEAR(product / kDraws / std::pow(2.0 * kDegree, 2), 0.0, 0.02);
}

TEST(Noise, NormalErrorsHaveTheLevelAsDeviation) {
  TrialRandom random(17);
  double angle = 0.0, share = 0.0, point = 0.0;
  const Eigen::Vector2d x1(0.1, 0.2);
  const Eigen::Vector2d exact = (some_homography() * x1.homogeneous()).hnormalized();
  for (int i = 0; i < kDraws; ++i) {
    const Errors e = errors_between(
        some_affinity(),
        noisy_affinity(some_affinity(), {0.0, 2.0, 3.0}, NoiseShape::kNormal, random));
    angle += e.first * e.first;
    share += e.large * e.large;
    const auto ac =
        noisy_correspondence(some_homography(), x1, {0.5, 0.0, 0.0}, NoiseShape::kNormal, random);
    point += (ac.x2 - exact).squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(angle / kDraws), 2.0 * kDegree, 0.03 * 2.0 * kDegree);
  EXPECT_NEAR(std::sqrt(share / kDraws), 0.03, 0.03 * 0.03);
  EXPECT_NEAR(std::sqrt(point / kDraws) * kStudyFocalPx, 0.5 * std::sqrt(2.0), 0.02);
}

TEST(Noise, ACommonAngleCancelsForASimilarity) {
  TrialRandom random(19);
  const Eigen::Matrix2d similarity = 1.2 * Eigen::Rotation2Dd(0.3).toRotationMatrix();
  double apart = 0.0;
  for (int i = 0; i < 100; ++i) {
    const auto common = noisy_affinity(similarity, {0.0, 5.0, 0.0}, NoiseShape::kCommon, random);
    EXPECT_LT((common - similarity).norm(), 1e-13);
    const auto own = noisy_affinity(similarity, {0.0, 5.0, 0.0}, NoiseShape::kUniform, random);
    apart = std::max(apart, (own - similarity).norm());
  }
  EXPECT_GT(apart, 0.1);
}

TEST(Noise, PointsMoveByTheLengthInAnyDirectionAndTheAffinityFollows) {
  TrialRandom random(23);
  const Eigen::Vector2d x1(0.1, 0.2);
  const Eigen::Matrix3d H = some_homography();
  const Eigen::Vector2d exact = (H * x1.homogeneous()).hnormalized();
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const auto ac = noisy_correspondence(H, x1, {0.7, 0.0, 0.0}, NoiseShape::kUniform, random);
    ASSERT_NEAR((ac.x2 - exact).norm() * kStudyFocalPx, 0.7, 1e-10);
    mean += (ac.x2 - exact) * kStudyFocalPx / kDraws;
    // The affine equations hold at the noisy point, with the true homography: only eq. (4) does
    // not.
    ASSERT_LT(homography_residual(H, ac).tail<4>().norm(), 1e-13);
  }
  EXPECT_LT(mean.norm(), 0.02);
}

}  // namespace
}  // namespace oneac
