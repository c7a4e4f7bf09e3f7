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
  acs.reserve(200);
  for (int i = 0; i < 200; ++i) {
    acs.push_back(scene.with_noise(scene.on_plane(T, scene.any_plane()), sigma, 0.0));
  }
  return acs;
}

/// Σ ρ at a pose.
double cost_at(const RelativePose& pose, const std::vector<AffineCorrespondence>& acs,
               double scale) {
  double cost = 0.0;
  for (const AffineCorrespondence& ac : acs) {
    const double r = sampson_distance(essential_matrix(pose), ac.x1, ac.x2);
    cost += r * r / (r * r + scale * scale);
  }
  return cost;
}

TEST(Polish, StopsWhereItsCostIsFlat) {
  SceneGenerator scene(11);
  constexpr double kScale = 1e-2;
  for (int trial = 0; trial < 20; ++trial) {
    RelativePose T = scene.general_motion();
    T.t.normalize();
    const auto acs = noisy_scene(scene, T, 5e-3);  // residuals that no approximation survives
    const PolishResult result = polish(T, acs, {kScale, 100, 1e-12});
    EXPECT_NEAR(result.cost, cost_at(result.pose, acs, kScale), 1e-9 * result.cost);
    for (int k = 0; k < 5; ++k) {
      const double h = 1e-5;
      const Eigen::Matrix<double, 5, 1> step = Eigen::Matrix<double, 5, 1>::Unit(k) * h;
      const double plus = cost_at(retract(result.pose, step), acs, kScale);
      const double minus = cost_at(retract(result.pose, -step), acs, kScale);
      const double curvature = (plus + minus - 2.0 * result.cost) / (h * h);
      // The slope as a distance from the minimum [rad].
      EXPECT_LT(std::abs(plus - minus) / (2.0 * h), 1e-6 * curvature) << "trial " << trial;
    }
  }
}

TEST(Polish, ConvergesQuadraticallyWhereItStartsNear) {
  SceneGenerator scene(17);
  for (int trial = 0; trial < 20; ++trial) {
    RelativePose T = scene.general_motion();
    T.t.normalize();
    auto acs = noisy_scene(scene, T, 5e-4);
    for (std::size_t i = 0; i < acs.size(); i += 6) acs[i].x2 = scene.image_point();
    PolishOptions options{2e-3, 100, 1e-9};
    const PolishResult best = polish(T, acs, options);
    Eigen::Matrix<double, 5, 1> off;
    for (int k = 0; k < 5; ++k) off(k) = scene.uniform(-1e-4, 1e-4);
    options.starts_near = true;
    const PolishResult result = polish(retract(best.pose, off), acs, options);
    EXPECT_NEAR(result.cost, best.cost, 1e-9 * best.cost) << "trial " << trial;
    EXPECT_LE(result.iterations, 5) << "trial " << trial;  // by weights alone twenty and more
    EXPECT_TRUE(result.information.isApprox(best.information, 1e-6)) << "trial " << trial;
  }
}

TEST(Polish, InSinglePrecisionEndsBesideTheDoubleOne) {
  SceneGenerator scene(16);
  for (int trial = 0; trial < 20; ++trial) {
    RelativePose T = scene.general_motion();
    T.t.normalize();
    const auto acs = noisy_scene(scene, T, 5e-4);
    const PolishResult exact = polish(T, acs, {2e-3, 50});
    const PolishResult coarse = polish_coarsely(T, PointSet(acs), {2e-3, 50, 1e-6});
    EXPECT_LT(rotation_error(coarse.pose.R, exact.pose.R), 1e-4) << "trial " << trial;
    EXPECT_LT(direction_error(coarse.pose.t, exact.pose.t), 1e-3) << "trial " << trial;
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
