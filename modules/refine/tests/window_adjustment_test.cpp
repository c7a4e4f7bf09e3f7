#include "window_adjustment.h"

#include "window_problem.h"
#include "window_scenes.h"

#include <algorithm>
#include <cstddef>

namespace oneac::test {
namespace {

constexpr double kToTheEnd = 1e-13;
constexpr AdjustmentEnds kAtTheEnd{kToTheEnd, 0.0};

WindowRefineOptions patient() {
  WindowRefineOptions options;
  options.max_iterations = 100;
  return options;
}

/// Every fifth observation of a view other than the anchor is off by some pixels.
SlidingWindow spoilt_window(std::uint64_t seed) {
  SceneGenerator generator(seed);
  const WindowScene scene = street_window(generator, 6, 120, {0.3, 0.05});
  SlidingWindow window = disturbed_window(generator, scene.truth);
  for (std::size_t i = 0; i < window.observations.size(); i += 5) {
    WindowObservation& seen = window.observations[i];
    if (seen.view == window.landmarks[seen.landmark].anchor) continue;
    seen.x += Eigen::Vector2d(5.0, -4.0) / window.focal_px;
  }
  return window;
}

WindowRefineResult adjusted(SlidingWindow& window, const WindowRefineOptions& options,
                            const AdjustmentEnds& ends, int threads = 1) {
  Workers workers(threads);
  WindowEquations equations(workers);
  return adjust_points(window, options, ends, equations);
}

TEST(WindowAdjustment, MeetsTheMinimumThatCeresFinds) {
  for (const std::uint64_t seed : {91U, 92U, 93U}) {
    SlidingWindow ours = spoilt_window(seed);
    SlidingWindow theirs = ours;
    WindowProblem problem(theirs, patient());
    const ceres::Solver::Summary summary = problem.solve(100, kToTheEnd);
    problem.store(theirs);
    const WindowRefineResult result = adjusted(ours, patient(), kAtTheEnd);
    ASSERT_TRUE(result.usable);
    EXPECT_NEAR(result.initial_cost, summary.initial_cost, 1e-9 * summary.initial_cost);
    EXPECT_NEAR(result.final_cost, summary.final_cost, 1e-6 * summary.final_cost);
    for (std::size_t i = 0; i < ours.views.size(); ++i) {
      const RelativePose& a = ours.views[i].T_view_map;
      const RelativePose& b = theirs.views[i].T_view_map;
      EXPECT_LT((a.R - b.R).norm(), 1e-5) << "view " << i;
      EXPECT_LT((a.t - b.t).norm(), 1e-4) << "view " << i;
    }
  }
}

TEST(WindowAdjustment, NeverRaisesItsCostAndKeepsRotationsOrthonormal) {
  SlidingWindow window = spoilt_window(94);
  WindowRefineOptions one_step;
  one_step.max_iterations = 1;
  double last = 0.0;
  for (int step = 0; step < 8; ++step) {
    const WindowRefineResult result = adjusted(window, one_step, {});
    ASSERT_TRUE(result.usable);
    EXPECT_LE(result.final_cost, result.initial_cost);
    last = result.final_cost;
  }
  EXPECT_GT(last, 0.0);
  for (const WindowView& view : window.views) {
    const Eigen::Matrix3d& R = view.T_view_map.R;
    EXPECT_LT((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  }
}

TEST(WindowAdjustment, EndsWhenPosesHaveFoundTheirPlaceThoughTheCostStillFalls) {
  SlidingWindow early = spoilt_window(96), late = early;
  const WindowRefineResult rested = adjusted(early, patient(), {kToTheEnd, 0.1});
  const WindowRefineResult ended = adjusted(late, patient(), kAtTheEnd);
  EXPECT_LT(rested.iterations, ended.iterations);
  EXPECT_GE(rested.final_cost, ended.final_cost);
  for (std::size_t i = 0; i < early.views.size(); ++i) {
    const RelativePose T = early.views[i].T_view_map * late.views[i].T_view_map.inverse();
    EXPECT_LT((T.R - Eigen::Matrix3d::Identity()).norm(), 1e-3) << "view " << i;
    EXPECT_LT(T.t.norm(), 1e-2) << "view " << i;
  }
}

TEST(WindowAdjustment, GivesTheSameBytesAtAnyThreadCount) {
  SlidingWindow alone = spoilt_window(97);
  const WindowRefineResult expected = adjusted(alone, patient(), kAtTheEnd);
  for (const int threads : {2, 4, 8}) {
    SlidingWindow shared = spoilt_window(97);
    const WindowRefineResult result = adjusted(shared, patient(), kAtTheEnd, threads);
    EXPECT_EQ(result.iterations, expected.iterations);
    EXPECT_EQ(result.final_cost, expected.final_cost);
    for (std::size_t i = 0; i < alone.views.size(); ++i) {
      EXPECT_EQ(shared.views[i].T_view_map.R, alone.views[i].T_view_map.R) << "view " << i;
      EXPECT_EQ(shared.views[i].T_view_map.t, alone.views[i].T_view_map.t) << "view " << i;
    }
    for (std::size_t i = 0; i < alone.landmarks.size(); ++i) {
      EXPECT_EQ(shared.landmarks[i].inverse_depth, alone.landmarks[i].inverse_depth) << i;
    }
  }
}

TEST(WindowAdjustment, LeavesNothingBehindForTheNextWindow) {
  Workers workers(2);
  WindowEquations used(workers);
  SlidingWindow before = spoilt_window(98), alone = spoilt_window(99);
  alone.landmarks.resize(60);
  alone.observations.erase(
      std::remove_if(alone.observations.begin(), alone.observations.end(),
                     [](const WindowObservation& seen) { return seen.landmark >= 60; }),
      alone.observations.end());
  SlidingWindow after = alone;
  static_cast<void>(adjust_points(before, patient(), kAtTheEnd, used));
  const WindowRefineResult second = adjust_points(after, patient(), kAtTheEnd, used);
  const WindowRefineResult first = adjusted(alone, patient(), kAtTheEnd);
  ASSERT_TRUE(first.usable);
  EXPECT_EQ(second.final_cost, first.final_cost);
  for (std::size_t i = 0; i < alone.views.size(); ++i) {
    EXPECT_EQ(after.views[i].T_view_map.t, alone.views[i].T_view_map.t) << "view " << i;
  }
}

TEST(WindowAdjustment, LeavesAWindowOfSingleSightingsAlone) {
  SlidingWindow window = spoilt_window(95);
  for (WindowObservation& seen : window.observations) {
    seen.view = window.landmarks[seen.landmark].anchor;
  }
  const SlidingWindow before = window;
  EXPECT_FALSE(adjusted(window, {}, kAtTheEnd).usable);
  for (std::size_t i = 0; i < window.landmarks.size(); ++i) {
    EXPECT_EQ(window.landmarks[i].inverse_depth, before.landmarks[i].inverse_depth);
  }
}

}  // namespace
}  // namespace oneac::test
