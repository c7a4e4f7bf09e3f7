#include "window_scenes.h"

#include "oneac/geometry/angular_errors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace oneac::test {
namespace {

double position_error(const SlidingWindow& a, const SlidingWindow& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.views.size(); ++i) {
    sum += (a.views[i].T_view_map.inverse().t - b.views[i].T_view_map.inverse().t).norm();
  }
  return sum / static_cast<double>(a.views.size());
}

TEST(SlidingWindow, RecoversPosesDepthsAndNormalsFromExactData) {
  SceneGenerator generator(81);
  const WindowScene scene = street_window(generator, 6, 80, {});
  for (const char* solver : {"fast", "ceres", "ceres+affine"}) {
    SlidingWindow window = disturbed_window(generator, scene.truth);
    WindowRefineOptions options;
    options.solver = solver;
    options.max_iterations = 50;
    const WindowRefineResult result = refine_window(window, options);
    ASSERT_TRUE(result.usable);
    EXPECT_LT(position_error(window, scene.truth), 1e-3);
    for (std::size_t i = 0; i < window.views.size(); ++i) {
      EXPECT_LT(rotation_error(window.views[i].T_view_map.R, scene.truth.views[i].T_view_map.R),
                1e-4);
    }
    std::size_t good = 0;
    for (std::size_t i = 0; i < window.landmarks.size(); ++i) {
      const WindowLandmark& found = window.landmarks[i];
      const WindowLandmark& truth = scene.truth.landmarks[i];
      if (std::abs(found.inverse_depth / truth.inverse_depth - 1.0) < 0.02 &&
          (found.gradient - truth.gradient).norm() < 0.3 * truth.inverse_depth)
        ++good;
    }
    EXPECT_GT(good, 68U);
  }
}

TEST(SlidingWindow, IsBetterThanItsStartUnderNoiseAndOutliers) {
  SceneGenerator generator(82);
  WindowScene scene = street_window(generator, 8, 150, {0.3, 0.05});
  for (std::size_t i = 0; i < scene.truth.observations.size(); i += 10) {
    scene.truth.observations[i].x += generator.image_point() * 0.1;
  }
  SlidingWindow window = disturbed_window(generator, scene.truth);
  const double before = position_error(window, scene.truth);
  const WindowRefineResult result = refine_window(window, {});
  ASSERT_TRUE(result.usable);
  EXPECT_LT(result.final_cost, result.initial_cost);
  EXPECT_LT(position_error(window, scene.truth), 0.5 * before);
}

TEST(SlidingWindow, KeepsFixedViewsAndTheScaleTheyHold) {
  SceneGenerator generator(83);
  const WindowScene scene = street_window(generator, 5, 100, {0.2, 0.05});
  SlidingWindow window = disturbed_window(generator, scene.truth);
  ASSERT_TRUE(refine_window(window, {}).usable);
  for (const std::size_t i : {0U, 1U}) {
    expect_same_pose(window.views[i].T_view_map, scene.truth.views[i].T_view_map);
  }
  const double length = (window.views.back().T_view_map.inverse().t).norm();
  EXPECT_NEAR(length / scene.truth.views.back().T_view_map.inverse().t.norm(), 1.0, 0.02);
}

TEST(SlidingWindow, IsDeterministic) {
  SceneGenerator generator(84);
  const WindowScene scene = street_window(generator, 6, 80, {0.3, 0.05});
  const SlidingWindow start = disturbed_window(generator, scene.truth);
  SlidingWindow a = start, b = start;
  static_cast<void>(refine_window(a, {}));
  static_cast<void>(refine_window(b, {}));
  for (std::size_t i = 0; i < a.views.size(); ++i) {
    expect_same_pose(a.views[i].T_view_map, b.views[i].T_view_map);
  }
}

TEST(SlidingWindow, FlagsAffinitiesThatNoPatchExplains) {
  SceneGenerator generator(85);
  WindowScene scene = street_window(generator, 4, 60, {0.1, 0.02});
  std::vector<std::size_t> spoilt;
  for (std::size_t i = 0; i < scene.truth.observations.size(); i += 7) {
    WindowObservation& seen = scene.truth.observations[i];
    if (seen.view == scene.truth.landmarks[seen.landmark].anchor) continue;
    seen.A.col(0) += Eigen::Vector2d(0.6, -0.6);
    spoilt.push_back(i);
  }
  static_cast<void>(fit_patches(scene.truth, {}));
  std::size_t caught = 0;
  for (const std::size_t i : spoilt) {
    if (!scene.truth.observations[i].affine_consistent) ++caught;
  }
  EXPECT_GE(caught, spoilt.size() * 8 / 10);
  ASSERT_GT(spoilt.size(), 10U);
}

TEST(SlidingWindow, PlanarPriorHoldsWhatTheImagesDoNot) {
  // Three distant points: the elevation of travel is hardly observed.
  SceneGenerator generator(86);
  WindowScene scene = street_window(generator, 3, 4, {0.3, 0.0});
  SlidingWindow window = scene.truth;
  window.views[2].T_view_map.t.y() += 0.3;
  SlidingWindow soft = window;
  WindowRefineOptions hard_options;
  hard_options.travel_elevation_deg = 0.01;
  WindowRefineOptions soft_options;
  soft_options.travel_elevation_deg = 80.0;
  static_cast<void>(refine_window(window, hard_options));
  static_cast<void>(refine_window(soft, soft_options));
  const auto height = [](const SlidingWindow& w) {
    return std::abs((w.views[2].T_view_map * w.views[1].T_view_map.inverse()).inverse().t.y());
  };
  EXPECT_LT(height(window), 1e-3);
  EXPECT_LT(height(window), height(soft));
}

TEST(SlidingWindow, InformationFollowsTheScatterOfManyTrials) {
  SceneGenerator generator(87);
  double chi2 = 0.0;
  constexpr int kTrials = 60;
  WindowRefineOptions options;
  options.loss_sigmas = 100.0;  // Gaussian noise, Gaussian estimate
  options.travel_elevation_deg = 80.0;
  options.suspension_deg = 80.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const WindowScene scene = street_window(generator, 3, 60, {0.2, 0.02});
    SlidingWindow window = scene.truth;
    ASSERT_TRUE(refine_window(window, options).usable);
    const RelativePose& found = window.views[2].T_view_map;
    const RelativePose& truth = scene.truth.views[2].T_view_map;
    const Eigen::AngleAxisd turn(found.R * truth.R.transpose());
    Eigen::Matrix<double, 6, 1> error;
    error << turn.angle() * turn.axis(), found.t - truth.t;
    chi2 += error.dot(view_information(window, 2, options) * error);
  }
  // Six degrees of freedom; the rays of the anchor are taken as known, which costs up to a
  // factor 2.
  EXPECT_GT(chi2 / kTrials, 3.0);
  EXPECT_LT(chi2 / kTrials, 15.0);
}

TEST(SlidingWindow, SurvivesALandmarkBehindAView) {
  SceneGenerator generator(88);
  const WindowScene scene = street_window(generator, 5, 80, {0.2, 0.05});
  SlidingWindow window = disturbed_window(generator, scene.truth);
  window.landmarks[0].inverse_depth = 5.0;  // 0.2 m ahead of a camera that drives 4 m
  const double before = position_error(window, scene.truth);
  ASSERT_TRUE(refine_window(window, {}).usable);
  EXPECT_LT(position_error(window, scene.truth), 0.5 * before);
}

TEST(SlidingWindow, RefusesMisuse) {
  WindowRefineOptions options;
  options.point_noise_px = 0.0;
  SlidingWindow window;
  EXPECT_THROW(static_cast<void>(refine_window(window, options)), std::invalid_argument);
  options = {};
  options.solver = "affine";
  EXPECT_THROW(static_cast<void>(refine_window(window, options)), std::invalid_argument);
  window.observations.push_back({});
  EXPECT_THROW(static_cast<void>(refine_window(window, {})), std::invalid_argument);
  SlidingWindow empty;
  EXPECT_FALSE(refine_window(empty, {}).usable);
}

}  // namespace
}  // namespace oneac::test
