#include "oneac/robust/gc_ransac.h"

#include "oneac/geometry/angular_errors.h"
#include "oneac/geometry/homography.h"
#include "oneac/geometry/levelling.h"
#include "oneac/solvers/registry.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

namespace oneac {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kFocal = 700.0;
const Eigen::Matrix3d kLevel = Eigen::Matrix3d::Identity();

Plane vertical_plane(double normal_angle, double distance) {
  return {{std::cos(normal_angle), 0.0, std::sin(normal_angle)}, distance};
}

/// A point of a random plane; the planes of a street when the solver wants one of them.
Plane plane_for(const Solver& solver, SceneGenerator& scene, int i) {
  switch (solver.surface) {
    case SolverSurface::kGround:
      return i % 2 == 0 ? scene.ground() : scene.any_plane();
    case SolverSurface::kSideWall:
      return i % 2 == 0 ? vertical_plane(0.0, 3.0) : scene.any_plane();
    case SolverSurface::kFrontWall:
      return i % 2 == 0 ? vertical_plane(90.0 * kDegree, 8.0) : scene.any_plane();
    case SolverSurface::kWall:
    case SolverSurface::kPlane:  // three of four on one wall, so that samples meet it
      return i % 4 != 0 ? vertical_plane(50.0 * kDegree, 6.0) : scene.any_plane();
    default:
      return scene.any_plane();
  }
}

RelativePose motion_for(const Solver& solver, SceneGenerator& scene) {
  if (solver.motion == SolverMotion::kCircular) {
    const double alpha = scene.uniform(-0.2, 0.2);
    return {yaw_rotation(std::cos(alpha), std::sin(alpha)),
            {std::sin(alpha / 2.0), 0.0, -std::cos(alpha / 2.0)}};
  }
  if (!solver.levelled()) return scene.general_motion();
  RelativePose T = scene.planar_motion();
  if (solver.motion == SolverMotion::kPitched) {
    const Eigen::Matrix3d pitch = pitch_rotation(1.5 * kDegree);
    T = {pitch * T.R, pitch * T.t};
  }
  return T;
}

/// 300 correspondences with a third of a pixel of noise; `outliers` of a hundred are wrong.
std::vector<AffineCorrespondence> scene_for(const Solver& solver, SceneGenerator& scene,
                                            const RelativePose& T, int outliers) {
  std::vector<AffineCorrespondence> acs;
  for (int i = 0; i < 300; ++i) {
    const Plane plane = plane_for(solver, scene, i);
    acs.push_back(scene.with_noise(scene.on_plane(T, plane), 0.3 / kFocal, 0.005));
    if (i % 100 < outliers) acs.back().x2 = scene.image_point();
  }
  return acs;
}

void expect_close(const RobustResult& result, const RelativePose& truth) {
  ASSERT_EQ(result.status, PoseStatus::kOk);
  EXPECT_LT(rotation_error(result.pose.R, truth.R), 0.2 * kDegree);
  EXPECT_LT(direction_error(result.pose.t, truth.t), 2.0 * kDegree);
  EXPECT_NEAR(result.pose.t.norm(), 1.0, 1e-9);
}

bool same_bits(const RobustResult& a, const RobustResult& b) {
  return a.pose.R == b.pose.R && a.pose.t == b.pose.t && a.inliers == b.inliers &&
         a.statistics.iterations == b.statistics.iterations &&
         a.statistics.graph_cuts == b.statistics.graph_cuts;
}

/// Two affinities give any motion few digits: of fifty hypotheses the best may lead to a wrong
/// optimum, of some hundred it does not.
GcRansacOptions options_for(const Solver& solver) {
  GcRansacOptions options;
  if (solver.name == "relpose_2ac") options.min_iterations = 300;
  return options;
}

class GcRansacMethod : public testing::TestWithParam<Solver> {};

TEST_P(GcRansacMethod, FindsTheMotionAmongFortyPercentOutliers) {
  SceneGenerator scene(31);
  for (int trial = 0; trial < 5; ++trial) {
    SCOPED_TRACE(trial);
    const RelativePose T = motion_for(GetParam(), scene);
    const auto acs = scene_for(GetParam(), scene, T, 40);
    const RobustResult result =
        gc_ransac(acs, kLevel, kFocal, GetParam(), 7, options_for(GetParam()));
    expect_close(result, T);
    EXPECT_GT(result.inlier_count, 150U);
    EXPECT_LT(result.inlier_count, 210U);
    EXPECT_GE(result.statistics.iterations, 50U);
    EXPECT_GE(result.statistics.local_optimisations, 1U);
    EXPECT_GE(result.statistics.graph_cuts, 1U);
  }
}

TEST_P(GcRansacMethod, WorksWithTheCamerasTilt) {
  SceneGenerator scene(32);
  const Eigen::Matrix3d L = levelling_rotation({8.0 * kDegree, 1.0 * kDegree});
  const RelativePose T = motion_for(GetParam(), scene);
  std::vector<AffineCorrespondence> acs;
  for (const auto& ac : scene_for(GetParam(), scene, T, 20)) {
    if (const auto tilted = rotate_views(ac, L.transpose(), L.transpose())) acs.push_back(*tilted);
  }
  expect_close(gc_ransac(acs, L, kFocal, GetParam(), 7, {}), unlevel(T, L));
}

TEST_P(GcRansacMethod, GivesTheSameBitsForTheSameSeed) {
  SceneGenerator scene(33);
  const auto acs = scene_for(GetParam(), scene, motion_for(GetParam(), scene), 40);
  for (const char* sampler : {"uniform", "prosac"}) {
    GcRansacOptions options;
    options.sampler = sampler;
    EXPECT_TRUE(same_bits(gc_ransac(acs, kLevel, kFocal, GetParam(), 5, options),
                          gc_ransac(acs, kLevel, kFocal, GetParam(), 5, options)));
  }
}

INSTANTIATE_TEST_SUITE_P(AllMethods, GcRansacMethod, testing::ValuesIn(solvers()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(GcRansac, DrawsOtherSamplesForAnotherSeed) {
  SceneGenerator scene(34);
  const auto acs = scene_for(solver_named("essential_5pc"), scene, scene.general_motion(), 40);
  GcRansacOptions raw;
  raw.lo_iterations = 0;
  const auto hypotheses = [&](std::uint64_t seed) {
    return gc_ransac(acs, kLevel, kFocal, solver_named("essential_5pc"), seed, raw)
        .statistics.hypotheses;
  };
  EXPECT_NE(hypotheses(1), hypotheses(2));
}

TEST(GcRansac, NeedsFewerIterationsWithFewerOutliers) {
  std::size_t previous = 0;
  for (int outliers : {10, 40, 60}) {
    SceneGenerator scene(35);
    const auto acs =
        scene_for(solver_named("essential_5pc"), scene, scene.general_motion(), outliers);
    GcRansacOptions options;
    options.min_iterations = 1;
    const auto result = gc_ransac(acs, kLevel, kFocal, solver_named("essential_5pc"), 1, options);
    EXPECT_GT(result.statistics.iterations, previous) << outliers << " % outliers";
    previous = result.statistics.iterations;
  }
}

TEST(GcRansac, IgnoresCorrespondencesThatAreNotFinite) {
  SceneGenerator scene(36);
  const RelativePose T = scene.planar_motion();
  auto acs = scene_for(solver_named("relpose_1ac_planar"), scene, T, 20);
  acs[30].A(0, 0) = std::numeric_limits<double>::quiet_NaN();
  acs[31].x2.x() = std::numeric_limits<double>::infinity();
  acs[32].x1.y() = std::numeric_limits<double>::quiet_NaN();
  const auto result = gc_ransac(acs, kLevel, kFocal, solver_named("relpose_1ac_planar"), 1, {});
  expect_close(result, T);
  ASSERT_EQ(result.inliers.size(), acs.size());
  for (std::size_t i : {30U, 31U, 32U}) EXPECT_FALSE(result.inliers[i]) << i;
  EXPECT_TRUE(std::isfinite(result.cost));
}

TEST(GcRansac, RefusesTooFewCorrespondencesAndNoise) {
  for (const Solver& solver : solvers()) {
    EXPECT_EQ(gc_ransac({}, kLevel, kFocal, solver, 1, {}).status, PoseStatus::kTooFew);
    SceneGenerator scene(37);
    std::vector<AffineCorrespondence> acs(40);
    for (auto& ac : acs)
      ac = {scene.image_point(), scene.image_point(), Eigen::Matrix2d::Identity()};
    GcRansacOptions strict;
    strict.min_inliers = 30;
    strict.max_iterations = 200;
    const RobustResult result = gc_ransac(acs, kLevel, kFocal, solver, 1, strict);
    EXPECT_EQ(result.status, PoseStatus::kTooFew) << solver.name;
    EXPECT_TRUE(result.pose.R.isIdentity());
    EXPECT_EQ(result.pose.t.norm(), 0.0);
    EXPECT_EQ(result.inliers.size(), acs.size());
  }
}

TEST(GcRansac, WorksWithoutOptimisationAndWithEitherRefit) {
  SceneGenerator scene(38);
  const RelativePose T = scene.general_motion();
  const auto acs = scene_for(solver_named("essential_5pc"), scene, T, 40);
  GcRansacOptions options;
  for (const char* model : {"8pc", "polish", "both"}) {
    options.lo_model = model;
    expect_close(gc_ransac(acs, kLevel, kFocal, solver_named("essential_5pc"), 1, options), T);
  }
  options.lo_iterations = 0;
  const auto raw = gc_ransac(acs, kLevel, kFocal, solver_named("essential_5pc"), 1, options);
  expect_close(raw, T);
  EXPECT_EQ(raw.statistics.local_optimisations, 0U);
  EXPECT_EQ(raw.statistics.graph_cuts, 0U);
}

TEST(GcRansac, StopsAfterEverySingleCorrespondenceWasDrawn) {
  SceneGenerator scene(39);
  const auto acs = scene_for(solver_named("relpose_1ac_ground"), scene, scene.planar_motion(), 40);
  GcRansacOptions options;
  options.min_iterations = options.max_iterations = 5000;
  for (const char* sampler : {"uniform", "prosac"}) {
    options.sampler = sampler;
    const auto result =
        gc_ransac(acs, kLevel, kFocal, solver_named("relpose_1ac_ground"), 1, options);
    EXPECT_EQ(result.statistics.iterations, acs.size()) << sampler;
  }
}

TEST(GcRansacOptions, NameFieldValueAndBound) {
  const auto fault = [](const std::function<void(GcRansacOptions&)>& spoil) -> std::string {
    GcRansacOptions options;
    spoil(options);
    try {
      options.validate();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(fault([](auto&) {}), "");
  EXPECT_EQ(fault([](auto& o) { o.threshold_px = -2.0; }),
            "gc_ransac.threshold_px = -2, must be positive");
  EXPECT_EQ(fault([](auto& o) { o.sampler = "napsac"; }),
            "gc_ransac.sampler = napsac, must be uniform or prosac");
  EXPECT_NE(fault([](auto& o) { o.confidence = 1.0; }), "");
  EXPECT_NE(fault([](auto& o) { o.min_iterations = 6000; }), "");
  EXPECT_NE(fault([](auto& o) { o.coherence = std::nan(""); }), "");
  EXPECT_NE(fault([](auto& o) { o.lo_model = "7pc"; }), "");
  EXPECT_NE(fault([](auto& o) { o.neighbourhood_cells = 0; }), "");
  EXPECT_NE(fault([](auto& o) { o.min_inliers = 4; }), "");
  EXPECT_THROW((void)gc_ransac({}, kLevel, -1.0, solver_named("essential_5pc"), 1, {}),
               std::invalid_argument);
}

}  // namespace
}  // namespace oneac
