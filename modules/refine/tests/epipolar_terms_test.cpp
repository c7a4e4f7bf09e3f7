#include "oneac/refine/epipolar_terms.h"

#include "epipolar_costs.h"
#include "refine_scenes.h"

#include "oneac/geometry/essential.h"

#include <ceres/manifold.h>
#include <ceres/sphere_manifold.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>

namespace oneac {
namespace {

using test::kFocal;

const CorrespondenceNoise kNoise{0.2 / kFocal, 0.05};

/// Fails when the derivatives of a term differ from central differences over the entries of E.
template <int N, class Term>
void expect_derivatives(const Term& term, const Eigen::Matrix3d& E) {
  const EpipolarTerm<N> at = term(E);
  constexpr double kStep = 1e-6;
  for (int entry = 0; entry < 9; ++entry) {
    Eigen::Matrix3d step = Eigen::Matrix3d::Zero();
    step(entry / 3, entry % 3) = kStep;
    const auto numeric = ((term(E + step).r - term(E - step).r) / (2.0 * kStep)).eval();
    for (int k = 0; k < N; ++k) {
      EXPECT_NEAR(at.dE[k](entry / 3, entry % 3), numeric(k), 1e-5 * (1.0 + at.dE[k].norm()))
          << "entry " << entry << ", residual " << k;
    }
  }
}

TEST(EpipolarTerms, DerivativesMatchDifferencesOverTheEssentialMatrix) {
  SceneGenerator generator(1);
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE(trial);
    const auto scene = test::street(generator, 1, {1.0, 0.1});
    const AffineCorrespondence& ac = scene.acs.front();
    const Eigen::Matrix3d E = essential_matrix(scene.truth);
    expect_derivatives<1>([&](const auto& M) { return point_term(M, ac, kNoise); }, E);
    expect_derivatives<2>([&](const auto& M) { return affine_term(M, ac, kNoise); }, E);
  }
}

TEST(EpipolarTerms, PoseDerivativeMatchesDifferencesOverThePose) {
  SceneGenerator generator(2);
  constexpr double kStep = 1e-6;
  for (int trial = 0; trial < 100; ++trial) {
    const auto scene = test::street(generator, 1, {1.0, 0.1});
    const auto residual = [&](const Eigen::Matrix<double, 6, 1>& d) {
      const RelativePose moved{rotation_from_vector(d.head<3>()) * scene.truth.R,
                               scene.truth.t + d.tail<3>()};
      return affine_term(essential_matrix(moved), scene.acs.front(), kNoise).r(1);
    };
    const auto term = affine_term(essential_matrix(scene.truth), scene.acs.front(), kNoise);
    const Eigen::Matrix<double, 1, 6> analytic = pose_derivative(term.dE[1], scene.truth);
    for (int i = 0; i < 6; ++i) {
      const Eigen::Matrix<double, 6, 1> step = kStep * Eigen::Matrix<double, 6, 1>::Unit(i);
      EXPECT_NEAR(analytic(i), (residual(step) - residual(-step)) / (2.0 * kStep),
                  1e-5 * (1.0 + analytic.norm()))
          << "trial " << trial << ", parameter " << i;
    }
  }
}

/// Residuals of a cost at a pose, moved by `step` along one parameter block's manifold. (Ceres'
/// GradientChecker is not used: it hands Eigen memory over, which AddressSanitizer builds cannot
/// free.)
template <class Cost>
Eigen::VectorXd residuals_at(const Cost& cost, const RelativePose& pose,
                             const Eigen::Vector3d& rotation_step,
                             const Eigen::Vector2d& direction_step) {
  const Eigen::Quaterniond q(pose.R);
  Eigen::Vector4d moved_q;
  Eigen::Vector3d moved_t;
  ceres::EigenQuaternionManifold().Plus(q.coeffs().data(), rotation_step.data(), moved_q.data());
  ceres::SphereManifold<3>().Plus(pose.t.data(), direction_step.data(), moved_t.data());
  const double* parameters[] = {moved_q.data(), moved_t.data()};
  Eigen::VectorXd residuals(cost.num_residuals());
  EXPECT_TRUE(cost.Evaluate(parameters, residuals.data(), nullptr));
  return residuals;
}

/// The analytic Jacobian of a cost in the five tangent parameters.
template <class Cost>
Eigen::MatrixXd tangent_jacobian(const Cost& cost, const RelativePose& pose) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Quaterniond q(pose.R);
  RowMajor dq(cost.num_residuals(), 4);
  RowMajor dt(cost.num_residuals(), 3);
  RowMajor plus_q(4, 3);
  RowMajor plus_t(3, 2);
  const double* parameters[] = {q.coeffs().data(), pose.t.data()};
  double* jacobians[] = {dq.data(), dt.data()};
  Eigen::VectorXd residuals(cost.num_residuals());
  EXPECT_TRUE(cost.Evaluate(parameters, residuals.data(), jacobians));
  EXPECT_TRUE(ceres::EigenQuaternionManifold().PlusJacobian(parameters[0], plus_q.data()));
  EXPECT_TRUE(ceres::SphereManifold<3>().PlusJacobian(parameters[1], plus_t.data()));
  Eigen::MatrixXd J(cost.num_residuals(), 5);
  J << dq * plus_q, dt * plus_t;
  return J;
}

template <class Cost>
void expect_jacobian_matches_differences() {
  constexpr double kStep = 1e-6;
  SceneGenerator generator(3);
  for (int trial = 0; trial < 50; ++trial) {
    const auto scene = test::street(generator, 1, {1.0, 0.1});
    const Cost cost(scene.acs.front(), kNoise);
    const Eigen::MatrixXd J = tangent_jacobian(cost, scene.truth);
    for (int i = 0; i < 5; ++i) {
      const Eigen::Matrix<double, 5, 1> step = kStep * Eigen::Matrix<double, 5, 1>::Unit(i);
      const Eigen::VectorXd ahead = residuals_at(cost, scene.truth, step.head<3>(), step.tail<2>());
      const Eigen::VectorXd behind =
          residuals_at(cost, scene.truth, -step.head<3>(), -step.tail<2>());
      const Eigen::VectorXd numeric = (ahead - behind) / (2.0 * kStep);
      EXPECT_LT((J.col(i) - numeric).norm(), 1e-5 * (1.0 + J.norm()))
          << "trial " << trial << ", parameter " << i;
    }
  }
}

TEST(EpipolarCosts, PointJacobianMatchesDifferences) {
  expect_jacobian_matches_differences<PointCost>();
}
TEST(EpipolarCosts, AffineJacobianMatchesDifferences) {
  expect_jacobian_matches_differences<AffineCost>();
}

TEST(EpipolarTerms, PointTermIsTheSampsonDistanceInStandardDeviations) {
  SceneGenerator generator(4);
  const auto scene = test::street(generator, 20, {1.0, 0.0});
  const Eigen::Matrix3d E = essential_matrix(scene.truth);
  for (const AffineCorrespondence& ac : scene.acs) {
    const double expected = sampson_distance(E, ac.x1, ac.x2) / kNoise.point;
    EXPECT_NEAR(point_term(E, ac, kNoise).r(0), expected, 1e-9 * (1.0 + std::abs(expected)));
  }
}

TEST(EpipolarTerms, VanishOnExactCorrespondences) {
  SceneGenerator generator(5);
  const auto scene = test::street(generator, 100, {});
  const Eigen::Matrix3d E = essential_matrix(scene.truth);
  for (const AffineCorrespondence& ac : scene.acs) {
    EXPECT_LT(std::abs(point_term(E, ac, kNoise).r(0)), 1e-9);
    EXPECT_LT(affine_term(E, ac, kNoise).r.norm(), 1e-9);
  }
}

TEST(EpipolarTerms, HaveUnitVarianceUnderTheirNoise) {
  SceneGenerator generator(6);
  double point = 0.0;
  double affine = 0.0;
  constexpr int kTrials = 4000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto scene = test::street(generator, 1, {kNoise.point * kFocal, kNoise.affine});
    const Eigen::Matrix3d E = essential_matrix(scene.truth);
    point += point_term(E, scene.acs.front(), kNoise).r.squaredNorm();
    affine += affine_term(E, scene.acs.front(), kNoise).r.squaredNorm() / 2.0;
  }
  EXPECT_NEAR(point / kTrials, 1.0, 0.1);
  EXPECT_NEAR(affine / kTrials, 1.0, 0.1);
}

TEST(EpipolarTerms, DoNotDependOnTheScaleOfTheEssentialMatrix) {
  SceneGenerator generator(7);
  const auto scene = test::street(generator, 1, {1.0, 0.1});
  const Eigen::Matrix3d E = essential_matrix(scene.truth);
  const AffineCorrespondence& ac = scene.acs.front();
  EXPECT_NEAR(point_term(E, ac, kNoise).r(0), point_term(7.0 * E, ac, kNoise).r(0), 1e-9);
  EXPECT_LT((affine_term(E, ac, kNoise).r - affine_term(7.0 * E, ac, kNoise).r).norm(), 1e-9);
}

TEST(EpipolarTerms, AreZeroWithoutAnEpipolarGeometry) {
  const AffineCorrespondence ac;
  const Eigen::Matrix3d none = Eigen::Matrix3d::Zero();
  EXPECT_EQ(point_term(none, ac, kNoise).r(0), 0.0);
  EXPECT_TRUE(point_term(none, ac, kNoise).dE[0].isZero(0.0));
  EXPECT_TRUE(affine_term(none, ac, kNoise).r.isZero(0.0));
  EXPECT_TRUE(affine_term(none, ac, kNoise).dE[1].isZero(0.0));
}

}  // namespace
}  // namespace oneac
