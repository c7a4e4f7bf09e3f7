#include "oneac/robust/polish.h"

#include "oneac/geometry/angular_errors.h"
#include "oneac/geometry/essential.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oneac {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

std::vector<AffineCorrespondence> noisy_scene(SceneGenerator& scene, const RelativePose& T,
                                              double sigma) {
  std::vector<AffineCorrespondence> acs;
  for (int i = 0; i < 200; ++i) {
    acs.push_back(scene.with_noise(scene.on_plane(T, scene.any_plane()), sigma, 0.0));
  }
  return acs;
}

TEST(SampsonJacobian, EqualsCentralDifferences) {
  SceneGenerator scene(11);
  for (int trial = 0; trial < 100; ++trial) {
    RelativePose T = scene.general_motion();
    T.t.normalize();
    const AffineCorrespondence ac =
        scene.with_noise(scene.on_plane(T, scene.any_plane()), 1e-2, 0.0);
    const SampsonJacobian analytic = sampson_jacobian(T, ac.x1, ac.x2);
    for (int k = 0; k < 5; ++k) {
      const double h = 1e-6;
      const Eigen::Matrix<double, 5, 1> step = Eigen::Matrix<double, 5, 1>::Unit(k) * h;
      const double plus = sampson_distance(essential_matrix(retract(T, step)), ac.x1, ac.x2);
      const double minus = sampson_distance(essential_matrix(retract(T, -step)), ac.x1, ac.x2);
      EXPECT_NEAR(analytic.J(k), (plus - minus) / (2.0 * h), 1e-6) << "trial " << trial;
    }
  }
}

TEST(Polish, ReachesTheTruthFromTwoDegreesAway) {
  SceneGenerator scene(12);
  for (int trial = 0; trial < 20; ++trial) {
    RelativePose truth = scene.general_motion();
    truth.t.normalize();
    const auto acs = noisy_scene(scene, truth, 0.0);
    Eigen::Matrix<double, 5, 1> off;
    for (int k = 0; k < 5; ++k) off(k) = scene.uniform(-0.01, 0.01);
    const PolishResult result = polish(retract(truth, off), acs, {0.02, 50});
    EXPECT_LT(rotation_error(result.pose.R, truth.R), 1e-6) << "trial " << trial;
    EXPECT_LT(direction_error(result.pose.t, truth.t), 1e-5) << "trial " << trial;
  }
}

TEST(Polish, IsNotMovedByOutliers) {
  SceneGenerator scene(13);
  RelativePose truth = scene.general_motion();
  truth.t.normalize();
  auto acs = noisy_scene(scene, truth, 3e-4);
  for (std::size_t i = 0; i < acs.size(); i += 3) acs[i].x2 = scene.image_point();
  const PolishResult result = polish(truth, acs, {1e-3, 50});
  EXPECT_LT(rotation_error(result.pose.R, truth.R), 0.1 * kDegree);
  EXPECT_LT(direction_error(result.pose.t, truth.t), 1.0 * kDegree);
}

TEST(Polish, NeverRaisesItsCost) {
  SceneGenerator scene(14);
  const RelativePose T = scene.general_motion();
  const auto acs = noisy_scene(scene, T, 1e-3);
  const RelativePose start = scene.general_motion();  // unrelated
  const double before = polish(start, acs, {1e-3, 0}).cost;
  EXPECT_LE(polish(start, acs, {1e-3, 30}).cost, before);
}

TEST(Polish, KeepsTheTranslationAUnitVector) {
  SceneGenerator scene(15);
  const RelativePose T = scene.general_motion();
  const PolishResult result = polish(T, noisy_scene(scene, T, 1e-3), {1e-3, 10});
  EXPECT_NEAR(result.pose.t.norm(), 1.0, 1e-12);
}

}  // namespace
}  // namespace oneac
