#include "oneac/simulation/laps.h"

#include "route.h"
#include "street_layout.h"

#include "oneac/geometry/angles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace oneac {
namespace {

using simulation::Box;
using simulation::Route;

SimulationOptions small_block() {
  SimulationOptions options;
  options.route = RouteKind::kBlock;
  options.block_m = 60.0;
  options.width_px = 160;
  options.height_px = 120;
  options.focal_px = 125.0;
  options.image_noise = 0.0;
  options.fps = 2.0;
  return options;
}

SimulationOptions laps_of(SimulationOptions options, int laps) {
  options.frames = frames_for_laps(options, laps);
  return options;
}

double mean_difference(const GreyImage& a, const GreyImage& b) {
  const int size = a.width() * a.height();
  double sum = 0.0;
  for (int i = 0; i < size; ++i) sum += std::abs(a.view().data[i] - b.view().data[i]);
  return sum / size;
}

TEST(Laps, ReturnToWhereTheyBegan) {
  const Route route(small_block(), 100.0);
  for (int lap = 1; lap <= 2; ++lap) {
    const auto state = route.at(route.lap_start_s(lap));
    EXPECT_LT(state.position.norm(), 1e-6) << lap;
    EXPECT_LT(std::abs(std::remainder(state.heading, 2.0 * kPi)), 1e-9) << lap;
  }
}

TEST(Laps, SurroundABlockOfTheLengthAskedFor) {
  const Route route(small_block(), 100.0);
  Eigen::Vector2d low(0.0, 0.0);
  Eigen::Vector2d high(0.0, 0.0);
  for (const Eigen::Vector2d& p : route.path()) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  EXPECT_NEAR(high.x() - low.x(), 60.0, 0.1);
  EXPECT_NEAR(high.y() - low.y(), 60.0, 0.1);
  EXPECT_EQ(route.legs().size(), 4U);
}

SimulationOptions figure8() {
  SimulationOptions options = small_block();
  options.route = RouteKind::kFigure8;
  return options;
}

TEST(Laps, OfAFigure8ReturnToWhereTheyBegan) {
  const Route route(figure8(), 200.0);
  for (int lap = 1; lap <= 2; ++lap) {
    const auto state = route.at(route.lap_start_s(lap));
    EXPECT_LT(state.position.norm(), 0.1 * lap) << lap;  // a street is of whole steps of 5 cm
    EXPECT_LT(std::abs(std::remainder(state.heading, 2.0 * kPi)), 1e-9) << lap;
  }
  EXPECT_EQ(route.legs().size(), 7U);
}

TEST(Laps, OfAFigure8GoRoundTwoBlocksAndCrossThemselvesOnce) {
  const Route route(figure8(), 200.0);
  Eigen::Vector2d low(0.0, 0.0), high(0.0, 0.0);
  double left = 0.0, right = 0.0;
  std::vector<double> headings;  // on the junction, where the bends would have their corner
  const double end_s = route.lap_start_s(1);
  for (double t = 0.0; t < end_s; t += 0.05) {
    const auto state = route.at(t);
    low = low.cwiseMin(state.position);
    high = high.cwiseMax(state.position);
    (state.curvature > 0.0 ? left : right) += state.curvature * state.speed * 0.05;
    const bool is_straight = std::abs(state.curvature) < 1e-9;
    const bool on_it = (state.position - Eigen::Vector2d(-11.0, 0.0)).norm() < 3.0;
    if (!is_straight || !on_it) continue;
    const double heading = std::remainder(state.heading, 2.0 * kPi);
    if (headings.empty() || std::abs(heading - headings.back()) > 0.1) headings.push_back(heading);
  }
  EXPECT_NEAR(left, 1.5 * kPi, 0.1);
  EXPECT_NEAR(right, -1.5 * kPi, 0.1);
  EXPECT_NEAR(high.x() - low.x(), 120.0, 0.3);
  EXPECT_NEAR(high.y() - low.y(), 120.0, 0.3);
  ASSERT_EQ(headings.size(), 2U);
  EXPECT_NEAR(std::abs(headings[0] - headings[1]), 0.5 * kPi, 1e-6);
}

TEST(Laps, AreCountedInTime) {
  const Route route(small_block(), 100.0);
  EXPECT_EQ(route.lap_at(0.0), 0);
  EXPECT_EQ(route.lap_at(route.lap_start_s(1) - 0.01), 0);
  EXPECT_EQ(route.lap_at(route.lap_start_s(1) + 0.01), 1);
  EXPECT_EQ(Route(SimulationOptions{}, 100.0).lap_at(90.0), 0);
}

TEST(Laps, EverySecondOneIsShiftedToTheLeft) {
  SimulationOptions options = small_block();
  options.lane_shift_m = 2.0;
  const Route route(options, 150.0);
  const double middle_s = 2.0;  // into the first street at full speed
  for (int lap = 0; lap < 4; ++lap) {
    const auto state = route.at(route.lap_start_s(lap) + middle_s);
    EXPECT_NEAR(state.position.y(), lap % 2 == 0 ? 0.0 : 2.0, 1e-6) << lap;
  }
}

TEST(Laps, TheTownDoesNotDependOnTheirNumber) {
  const auto town = [](double duration_s) {
    return simulation::lay_out_street(Route(small_block(), duration_s), {3});
  };
  const std::vector<Box> one = town(10.0);
  const std::vector<Box> many = town(300.0);
  // Buildings keep clear of the points of the path: the same ones, then, whatever is driven.
  EXPECT_EQ(Route(small_block(), 10.0).path(), Route(small_block(), 300.0).path());
  ASSERT_EQ(one.size(), many.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].low, many[i].low) << i;
    EXPECT_EQ(one[i].high, many[i].high) << i;
  }
}

TEST(Laps, NothingStandsInTheirWay) {
  SimulationOptions options = small_block();
  options.lane_shift_m = 2.0;
  const Route route(options, 100.0);
  for (const bool other : {false, true}) {
    const std::vector<Box> boxes = simulation::lay_out_street(route, {1, false, other});
    EXPECT_GT(boxes.size(), 40U);
    for (const Eigen::Vector2d& p : route.path()) {
      for (const Box& box : boxes) {
        const Eigen::Vector2d nearest = p.cwiseMax(box.low.head<2>()).cwiseMin(box.high.head<2>());
        EXPECT_GT((p - nearest).norm(), 2.0);
      }
    }
  }
}

TEST(TrueLoops, FollowTheWholeSecondLapAndNoneOfTheFirst) {
  SimulationOptions options = small_block();
  options.lane_shift_m = 1.0;
  const StreetSimulator simulator(laps_of(options, 2));
  const std::vector<TrueLoop> loops = true_loops(simulator);
  ASSERT_FALSE(loops.empty());
  const auto half = static_cast<double>(simulator.size()) / 2.0;
  EXPECT_NEAR(static_cast<double>(loops.front().index2), half, 0.1 * half);
  EXPECT_GT(static_cast<double>(loops.size()), 0.9 * half);
  for (const TrueLoop& loop : loops) {
    const auto T_w_1 = simulator.state(loop.index1).T_world_cam;
    const auto T_w_2 = simulator.state(loop.index2).T_world_cam;
    EXPECT_TRUE((T_w_2 * loop.T_2_1).isApprox(T_w_1, 1e-9));
    EXPECT_LT(loop.T_2_1.translation().norm(), 3.0);
    EXPECT_LT(loop.index1, loop.index2);
  }
}

TEST(TrueLoops, OfAFigure8AreThoseOfItsSecondLap) {
  const StreetSimulator simulator(laps_of(figure8(), 2));
  const std::vector<TrueLoop> loops = true_loops(simulator);
  EXPECT_GT(loops.size(), simulator.size() / 2 - 10);
  for (const TrueLoop& loop : loops) {
    EXPECT_LT(loop.T_2_1.translation().norm(), 3.0);
    EXPECT_GT(loop.index2, simulator.size() / 2 - 3) << "at the junction it crosses itself";
  }
}

TEST(TrueLoops, AreNoneWhereTheRouteNeverMeetsItself) {
  SimulationOptions options = small_block();
  options.route = RouteKind::kStreet;
  options.frames = 80;
  EXPECT_TRUE(true_loops(StreetSimulator(options)).empty());
}

TEST(Relight, ChangesTheSecondLapAndNotTheFirst) {
  SimulationOptions options = laps_of(small_block(), 2);
  const StreetSimulator plain(options);
  options.relight = true;
  const StreetSimulator relit(options);
  EXPECT_EQ(mean_difference(plain.frame(2).left, relit.frame(2).left), 0.0);
  const std::size_t later = plain.size() / 2 + 4;
  EXPECT_GT(mean_difference(plain.frame(later).left, relit.frame(later).left), 10.0);
}

TEST(Alike, MakesAnotherStreetLookLikeTheFirst) {
  // Streets 0 and 3 show their facades in the same direction of reading.
  SimulationOptions options = small_block();
  options.suspension_pitch_deg = options.suspension_roll_deg = 0.0;
  const auto street_0_against_3 = [](const SimulationOptions& chosen) {
    const StreetSimulator simulator(chosen);
    const Route route(chosen, 100.0);
    const auto& leg = route.legs()[3];
    Eigen::Isometry3d T_town_leg = Eigen::Isometry3d::Identity();
    T_town_leg.linear() = Eigen::AngleAxisd(1.5 * kPi, Eigen::Vector3d::UnitZ()).matrix();
    T_town_leg.translation() << leg.start, 0.0;
    const Eigen::Isometry3d T_leg_cam = simulator.state(0).T_world_cam;
    return mean_difference(simulator.render(T_leg_cam), simulator.render(T_town_leg * T_leg_cam));
  };
  const double unlike = street_0_against_3(options);
  options.alike = true;
  EXPECT_LT(street_0_against_3(options), 0.6 * unlike);
}

TEST(SimulationOptions, LapsNeedABlockAndAnEmptyRoad) {
  SimulationOptions options;
  EXPECT_THROW((void)frames_for_laps(options, 2), std::invalid_argument);
  options.relight = true;
  EXPECT_THROW(options.validate(), std::invalid_argument);
  options = SimulationOptions{};
  options.lane_shift_m = 1.0;
  EXPECT_THROW(options.validate(), std::invalid_argument);
  options = small_block();
  EXPECT_NO_THROW(options.validate());
  EXPECT_THROW((void)frames_for_laps(options, 0), std::invalid_argument);
  options.traffic = Traffic::kCrossing;
  EXPECT_THROW(options.validate(), std::invalid_argument);
}

}  // namespace
}  // namespace oneac
