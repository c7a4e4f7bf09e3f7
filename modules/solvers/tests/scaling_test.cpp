// What must not depend on the size of numbers: weights, coefficients, the angle of view.
#include "math/least_squares_null_vector.h"
#include "math/polynomial.h"
#include "point_solver_tools.h"

#include "oneac/solvers/essential_8pc.h"
#include "oneac/solvers/homography_2ac.h"
#include "oneac/solvers/homography_4pc.h"
#include "oneac/solvers/relpose_1ac_planar.h"
#include "oneac/solvers/relpose_1pc_ackermann.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace oneac {
namespace {

using namespace test;

// Smaller than the trace of any normal matrix of a few rows, far from the least double.
constexpr double kTinyWeight = 1e-9;

TEST(Scaling, SizeOfTheWeightsDoesNotMatterToPlanarMotion) {
  SceneGenerator scene(11);
  const std::vector<double> weights(6, kTinyWeight);
  for (int i = 0; i < 100; ++i) {
    const RelativePose T = scene.planar_motion();
    const auto found = relpose_nac_planar(scattered(scene, T, 6), weights.data());
    ASSERT_EQ(found.size(), 1u) << "scene " << i << " of seed 11";
    EXPECT_LT(pose_error(found[0].pose(), T), kExact) << "scene " << i << " of seed 11";
  }
}

TEST(Scaling, SizeOfTheWeightsDoesNotMatterToEssentialMatricesAndHomographies) {
  SceneGenerator scene(12);
  const std::vector<double> weights(12, kTinyWeight);
  for (int i = 0; i < 100; ++i) {
    const RelativePose T = scene.planar_motion();
    const Plane plane = scene.ground();
    const auto scattered_points = scattered(scene, T, 12);
    const auto on_plane = on_one_plane(scene, T, plane, 12);
    EXPECT_EQ(essential_8pc(scattered_points, weights.data()).size(), 1u) << "scene " << i;
    EXPECT_EQ(homography_4pc(on_plane, weights.data()).size(), 1u) << "scene " << i;
    EXPECT_EQ(homography_2ac(on_plane, weights.data()).size(), 1u) << "scene " << i;
  }
}

TEST(Scaling, SizeOfTheCoefficientsDoesNotMatterToTheRoots) {
  // (x² − 1/4)(x² − 4), once as it is and once tiny.
  const double plain[5] = {1.0, 0.0, -4.25, 0.0, 1.0};
  double tiny[5];
  for (int i = 0; i < 5; ++i) tiny[i] = 1e-20 * plain[i];
  const internal::RealRoots<4> expected(plain), found(tiny);
  ASSERT_EQ(expected.size(), 4);
  ASSERT_EQ(found.size(), 4);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(found[i], expected[i], 1e-12);
}

/// Twelve rows that vanish along `null` and are 1e-4 of the others' size along one more direction.
Eigen::Matrix<double, 12, 4> nearly_two_null_vectors(SceneGenerator& scene, Eigen::Vector4d& null) {
  Eigen::Matrix<double, 12, 4> rows;
  Eigen::Vector4d weak;
  for (double& entry : rows.reshaped()) entry = scene.uniform(-1.0, 1.0);
  for (double& entry : null) entry = scene.uniform(-1.0, 1.0);
  for (double& entry : weak) entry = scene.uniform(-1.0, 1.0);
  null.normalize();
  weak = (weak - null * null.dot(weak)).normalized();
  rows -= rows * null * null.transpose();
  rows -= (1.0 - 1e-4) * rows * weak * weak.transpose();
  return rows;
}

// The eigenvector of the normal equations alone is off by 1e-8 here.
TEST(Scaling, ANullVectorKeepsItsDigitsBesideAWeakSingularValue) {
  SceneGenerator scene(15);
  for (int i = 0; i < 100; ++i) {
    Eigen::Vector4d null;
    const Eigen::Matrix<double, 12, 4> rows = nearly_two_null_vectors(scene, null);
    const auto found =
        internal::least_squares_null_vector<4>([&](auto&& use) { use(rows, 1.0); }, 1e-14);
    ASSERT_TRUE(found.has_value()) << "case " << i << " of seed 15";
    EXPECT_LT(1.0 - std::abs(found->dot(null)), 1e-14) << "case " << i << " of seed 15";
    EXPECT_LT((*found - null * null.dot(*found)).norm(), 1e-10) << "case " << i << " of seed 15";
  }
}

/// A point far out in a wide image, x = ±3 of a lens of more than 140°.
AffineCorrespondence far_out(SceneGenerator& scene, const RelativePose& T) {
  const double side = scene.uniform(-1.0, 1.0) > 0.0 ? 1.0 : -1.0;
  const double depth = scene.uniform(6.0, 10.0);
  const Eigen::Vector3d X1(side * scene.uniform(2.8, 3.2) * depth, 0.3 * depth, depth);
  return in_both_views(T, X1);
}

TEST(Scaling, CircularMotionIsFoundAtAnyAngleOfView) {
  SceneGenerator scene(13);
  for (int i = 0; i < 1000; ++i) {
    const double alpha = scene.uniform(-0.05, 0.05);
    const RelativePose T = circular_motion(alpha, 1.3);
    const AffineCorrespondence ac = far_out(scene, T);
    const auto found = relpose_1pc_ackermann(AcSpan(&ac, 1));
    ASSERT_EQ(found.size(), 1u) << "scene " << i << " of seed 13";
    EXPECT_LT(pose_error(found[0].pose(), T), kExact) << "scene " << i << " of seed 13";
  }
}

// Half of it is nearer to a right angle than to none: the other form of the eigenvector.
TEST(Scaling, CircularMotionIsFoundThroughTurnsOfMoreThanARightAngle) {
  SceneGenerator scene(14);
  for (int i = 0; i < 1000; ++i) {
    const double side = scene.uniform(-1.0, 1.0) > 0.0 ? 1.0 : -1.0;
    const double alpha = side * scene.uniform(1.75, 2.2);
    const RelativePose T = circular_motion(alpha, 1.3);
    const double azimuth = scene.uniform(-0.1, 0.1) + alpha / 2;  // enters and leaves at the sides
    const Eigen::Vector3d X1 =
        scene.uniform(6.0, 10.0) * Eigen::Vector3d(std::sin(azimuth), 0.3, std::cos(azimuth));
    ASSERT_GT((T * X1).z(), 0.0) << "scene " << i << " of seed 14";
    const AffineCorrespondence ac = in_both_views(T, X1);
    const auto found = relpose_1pc_ackermann(AcSpan(&ac, 1));
    ASSERT_EQ(found.size(), 1u) << "scene " << i << " of seed 14";
    EXPECT_LT(pose_error(found[0].pose(), T), kExact) << "scene " << i << " of seed 14";
  }
}

}  // namespace
}  // namespace oneac
