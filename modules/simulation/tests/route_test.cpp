#include "route.h"

#include "street_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace oneac::simulation {
namespace {

constexpr double kQuarterTurn = 1.5707963267948966;
constexpr double kDuration = 60.0;

TEST(Route, KeepsWithinTheConfiguredAccelerations) {
  const SimulationOptions options;
  const Route route(options, kDuration);
  constexpr double kStep = 0.01;
  double t = kStep;
  while (t < kDuration) {
    const double rate = (route.at(t).speed - route.at(t - kStep).speed) / kStep;
    EXPECT_LT(rate, options.acceleration_mps2 + 1e-6) << t;
    EXPECT_GT(rate, -options.braking_mps2 - 1e-6) << t;
    EXPECT_LE(route.at(t).speed, options.speed_mps + 1e-9);
    t += kStep;
  }
}

TEST(Route, MovesAlongItsHeadingAsFastAsItSays) {
  const Route route(SimulationOptions{}, kDuration);
  constexpr double kStep = 0.001;
  double t = 0.05;
  while (t < kDuration) {
    const PlanarState now = route.at(t);
    const Eigen::Vector2d velocity =
        (route.at(t + kStep).position - route.at(t - kStep).position) / (2.0 * kStep);
    const Eigen::Vector2d expected =
        now.speed * Eigen::Vector2d(std::cos(now.heading), std::sin(now.heading));
    EXPECT_LT((velocity - expected).norm(), 0.01) << t;
    t += 0.05;
  }
}

TEST(Route, TurnsByQuarterTurnsAlternately) {
  const Route route(SimulationOptions{}, kDuration);
  ASSERT_GE(route.legs().size(), 4U);
  const int first = route.legs()[1].quadrant - route.legs()[0].quadrant;
  EXPECT_EQ(std::abs(first) % 2, 1);
  EXPECT_EQ(route.legs()[2].quadrant, route.legs()[0].quadrant);
  const double end_of_leg_1 = 24.0;  // default drive: past the first bend, on the second street
  EXPECT_NEAR(std::abs(route.at(end_of_leg_1 * 0.5).heading), kQuarterTurn, 1e-9);
}

TEST(Route, StandsStillForTheConfiguredTime) {
  SimulationOptions options;
  options.stop_s = 4.0;
  const Route route(options, kDuration);
  double standing = 0.0;
  constexpr double kStep = 0.01;
  double t = 0.0;
  while (t < 30.0) {
    if (route.at(t).speed == 0.0) standing += kStep;
    t += kStep;
  }
  EXPECT_NEAR(standing, options.stop_s, 0.05);
}

TEST(StreetLayout, KeepsTheLaneFree) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SimulationOptions options;
    options.seed = seed;
    const Route route(options, kDuration);
    const std::vector<Box> boxes = lay_out_street(route, {seed});
    EXPECT_GT(boxes.size(), 40U);
    double t = 0.0;
    while (t < kDuration) {
      const Eigen::Vector2d p = route.at(t).position;
      for (const Box& box : boxes) {
        const Eigen::Vector2d nearest = p.cwiseMax(box.low.head<2>()).cwiseMin(box.high.head<2>());
        EXPECT_GT((p - nearest).norm(), 2.0) << "seed " << seed << ", time " << t;
      }
      t += 0.05;
    }
  }
}

TEST(StreetLayout, HasAWallAcrossTheEndOfTheFirstStreet) {
  const Route route(SimulationOptions{}, kDuration);
  const Leg& leg = route.legs().front();
  const std::vector<Box> boxes = lay_out_street(route, {1});
  const bool across = std::any_of(boxes.begin(), boxes.end(), [&](const Box& box) {
    return box.kind == Box::Kind::kBuilding && box.low.x() > leg.length_m &&
           box.low.x() < leg.length_m + 40.0 && box.low.y() < 6.0 && box.high.y() > -6.0;
  });
  EXPECT_TRUE(across);
}

}  // namespace
}  // namespace oneac::simulation
