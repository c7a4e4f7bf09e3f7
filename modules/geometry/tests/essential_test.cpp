#include "oneac/geometry/essential.h"

#include "oneac/geometry/angular_errors.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace oneac {
namespace {

constexpr int kScenes = 1000;

struct Scene {
  RelativePose T;
  Eigen::Matrix3d E;
  AffineCorrespondence ac;
};

Scene random_scene(SceneGenerator& scenes) {
  Scene scene;
  scene.T = scenes.general_motion();
  scene.E = essential_matrix(scene.T);
  scene.ac = scenes.on_plane(scene.T, scenes.any_plane());
  return scene;
}

/// Distance from (x1, x2) to the nearest pair that satisfies E: sequential quadratic programming.
double geometric_distance(const Eigen::Matrix3d& E, const AffineCorrespondence& ac) {
  const Eigen::Vector4d measured(ac.x1.x(), ac.x1.y(), ac.x2.x(), ac.x2.y());
  Eigen::Vector4d z = measured;
  for (int iteration = 0; iteration < 20; ++iteration) {
    const Eigen::Vector3d x1 = z.head<2>().homogeneous();
    const Eigen::Vector3d x2 = z.tail<2>().homogeneous();
    Eigen::Vector4d gradient;
    gradient << (E.transpose() * x2).head<2>(), (E * x1).head<2>();
    const double linearised = x2.dot(E * x1) + gradient.dot(measured - z);
    z = measured - gradient * linearised / gradient.squaredNorm();
  }
  return (z - measured).norm();
}

TEST(EssentialMatrix, IsZeroOnTruePointPairs) {
  SceneGenerator scenes(3);
  for (int i = 0; i < kScenes; ++i) {
    const Scene s = random_scene(scenes);
    const double value = s.ac.x2.homogeneous().dot(s.E * s.ac.x1.homogeneous());
    EXPECT_NEAR(value, 0.0, 1e-12) << "seed 3, scene " << i;
  }
}

TEST(EssentialMatrix, KeepsTheScaleOfTheTranslation) {
  const RelativePose T{Eigen::Matrix3d::Identity(), {0, 0, -3}};
  EXPECT_NEAR(essential_matrix(T).norm(), 3.0 * std::sqrt(2.0), 1e-14);
}

TEST(DecomposeEssential, ContainsTheTruthForEitherSignAndAnyScale) {
  SceneGenerator scenes(4);
  for (int i = 0; i < kScenes; ++i) {
    const Scene s = random_scene(scenes);
    const double scale = scenes.uniform(0.1, 5.0) * (i % 2 == 0 ? 1.0 : -1.0);
    const auto motions = decompose_essential(scale * s.E);
    const bool found = std::any_of(motions.begin(), motions.end(), [&](const RelativePose& T) {
      return rotation_error(T.R, s.T.R) < 1e-9 && direction_error(T.t, s.T.t) < 1e-9;
    });
    EXPECT_TRUE(found) << "seed 4, scene " << i;
  }
}

TEST(DecomposeEssential, ReturnsFourProperMotionsThatExplainTheMatrix) {
  SceneGenerator scenes(5);
  for (int i = 0; i < 100; ++i) {
    const Scene s = random_scene(scenes);
    for (const RelativePose& T : decompose_essential(s.E)) {
      EXPECT_NEAR(T.R.determinant(), 1.0, 1e-12);
      EXPECT_NEAR((T.R * T.R.transpose() - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-12);
      EXPECT_NEAR(T.t.norm(), 1.0, 1e-12);
      const Eigen::Matrix3d E = essential_matrix(T) * s.T.t.norm();
      EXPECT_LT(std::min((E - s.E).norm(), (E + s.E).norm()), 1e-9) << "seed 5, scene " << i;
    }
  }
}

TEST(DecomposeEssential, RefusesNumbersThatAreNotFinite) {
  Eigen::Matrix3d E = essential_matrix({Eigen::Matrix3d::Identity(), {0, 0, 1}});
  E(0, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)decompose_essential(E), std::invalid_argument);
}

TEST(SampsonDistance, IsTheGeometricDistanceToFirstOrder) {
  SceneGenerator scenes(6);
  for (int i = 0; i < kScenes; ++i) {
    Scene s = random_scene(scenes);
    // A pixel or so at f = 1000 px, in both images.
    for (int axis = 0; axis < 2; ++axis) s.ac.x1(axis) += scenes.normal(1e-3);
    s.ac = scenes.with_noise(s.ac, 1e-3, 0.0);
    const double exact = geometric_distance(s.E, s.ac);
    EXPECT_NEAR(std::abs(sampson_distance(s.E, s.ac.x1, s.ac.x2)), exact, 0.02 * exact + 1e-7)
        << "seed 6, scene " << i;
  }
}

TEST(SampsonDistance, SplitsAnErrorAcrossTheEpipolarLinesBetweenBothImages) {
  // Sideways motion: epipolar lines are rows, and a vertical error e is shared: e / √2.
  const Eigen::Matrix3d E = essential_matrix({Eigen::Matrix3d::Identity(), {1, 0, 0}});
  EXPECT_NEAR(std::abs(sampson_distance(E, {0.1, 0.2}, {0.3, 0.21})), 0.01 / std::sqrt(2), 1e-12);
  EXPECT_NEAR(sampson_distance(E, {0.1, 0.2}, {0.7, 0.2}), 0.0, 1e-15);  // along the line
}

TEST(SampsonDistance, IsSignedAndFreeOfTheScaleOfE) {
  const Eigen::Matrix3d E = essential_matrix({Eigen::Matrix3d::Identity(), {1, 0, 0}});
  const double distance = sampson_distance(E, {0, 0}, {0, 0.01});
  EXPECT_NE(distance, 0.0);
  EXPECT_DOUBLE_EQ(sampson_distance(E, {0, 0}, {0, -0.01}), -distance);
  EXPECT_DOUBLE_EQ(sampson_distance(7.0 * E, {0, 0}, {0, 0.01}), distance);
}

TEST(SampsonDistance, IsZeroWithoutEpipolarLines) {
  EXPECT_EQ(sampson_distance(Eigen::Matrix3d::Zero(), {0.1, 0.2}, {0.3, 0.4}), 0.0);
  // Both points in their epipoles.
  const Eigen::Matrix3d E = essential_matrix({Eigen::Matrix3d::Identity(), {0, 0, 1}});
  EXPECT_EQ(sampson_distance(E, {0, 0}, {0, 0}), 0.0);
}

TEST(AffineEpipolarResidual, IsZeroForExactCorrespondences) {
  SceneGenerator scenes(7);
  for (int i = 0; i < kScenes; ++i) {
    const Scene s = random_scene(scenes);
    EXPECT_LT(affine_epipolar_residual(s.E, s.ac).norm(), 1e-12) << "seed 7, scene " << i;
  }
}

TEST(AffineEpipolarResidual, SeesAWrongAffinity) {
  SceneGenerator scenes(8);
  for (int i = 0; i < kScenes; ++i) {
    Scene s = random_scene(scenes);
    Eigen::Matrix2d error;
    error << 0.1, 0.0, 0.0, 0.1;
    s.ac.A += error;
    const double expected = 0.1 * (s.E * s.ac.x1.homogeneous()).head<2>().norm();
    EXPECT_NEAR(affine_epipolar_residual(s.E, s.ac).norm(), expected, 1e-12);
    EXPECT_GT(expected, 0.0) << "seed 8, scene " << i;
  }
}

TEST(AffineEpipolarResidual, IsTheDerivativeOfTheEpipolarConstraint) {
  // d/dx1 of x2(x1)ᵀ E x1 with x2 moving by A dx1, for a correspondence that obeys nothing.
  SceneGenerator scenes(9);
  const Eigen::Matrix3d E = Eigen::Matrix3d::NullaryExpr([&] { return scenes.uniform(-1, 1); });
  AffineCorrespondence ac{{0.1, -0.2}, {0.3, 0.25}, {}};
  ac.A << 1.2, 0.1, -0.3, 0.8;
  const auto value = [&](const Eigen::Vector2d& dx) {
    return (ac.x2 + ac.A * dx).homogeneous().dot(E * (ac.x1 + dx).homogeneous());
  };
  constexpr double kStep = 1e-6;
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d dx = kStep * Eigen::Vector2d::Unit(axis);
    const double slope = (value(dx) - value(-dx)) / (2.0 * kStep);
    EXPECT_NEAR(affine_epipolar_residual(E, ac)(axis), slope, 1e-9);
  }
}

}  // namespace
}  // namespace oneac
