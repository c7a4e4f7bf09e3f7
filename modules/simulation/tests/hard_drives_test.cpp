#include "oneac/simulation/hard_drives.h"

#include "along_traffic.h"
#include "camera_mount.h"
#include "street_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace oneac {
namespace {

using simulation::Box;
using simulation::MovingVehicle;
using simulation::Route;

constexpr double kQuarterTurn = 1.5707963267948966;

Route route_of(const SimulationOptions& options, double duration_s = 24.0) {
  return Route(options, duration_s);
}

SimulationOptions on(RouteKind kind) {
  SimulationOptions options;
  options.route = kind;
  return options;
}

TEST(HardDrives, HaveNamesOfTheirOwnAndDifferFromTheDefault) {
  std::set<std::string> names;
  for (const HardDrive& drive : hard_drives()) {
    EXPECT_TRUE(names.insert(drive.name).second) << drive.name;
    EXPECT_FALSE(drive.what.empty()) << drive.name;
    EXPECT_NO_THROW(drive.options.validate()) << drive.name;
  }
  EXPECT_GE(names.size(), 18U);
}

TEST(HardDrives, AnUnknownNameIsRefusedWithTheNamesThereAre) {
  try {
    (void)hard_drive("moon");
    FAIL() << "found the moon";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("roundabout"), std::string::npos) << error.what();
  }
}

TEST(StopAndGo, StandsAgainAndAgain) {
  const Route route = route_of(hard_drive("stop-and-go").options);
  const auto stops = route.stops();
  ASSERT_GE(stops.size(), 3U);
  for (std::size_t i = 0; i < stops.size() && stops[i].time_s < 24.0; ++i) {
    EXPECT_EQ(route.at(stops[i].time_s + 0.5 * stops[i].wait_s).speed, 0.0) << i;
    EXPECT_NEAR(route.at(stops[i].time_s + 0.1).position.x(), stops[i].x, 1e-6) << i;
  }
}

TEST(Roundabout, IsEnteredAndLeftAlongTheStreets) {
  SimulationOptions options = on(RouteKind::kRoundabout);
  const Route route = route_of(options, 90.0);
  ASSERT_GE(route.legs().size(), 3U);
  EXPECT_EQ((route.legs()[1].quadrant - route.legs()[0].quadrant) & 3, 1);
  EXPECT_EQ(route.legs()[2].quadrant, route.legs()[1].quadrant);
  double rightmost = 0.0;
  double last = route.at(0.0).heading;
  double t = 0.0;
  while (t < 20.0) {
    const double heading = route.at(t).heading;
    EXPECT_LT(std::abs(heading - last), 0.03) << "a kink at " << t;
    rightmost = std::min(rightmost, heading);
    last = heading;
    t += 0.05;
  }
  EXPECT_LT(rightmost, -0.5 * kQuarterTurn);  // aside before it turns left
}

TEST(Roundabout, MeetsNothingThatStandsThere) {
  const Route route = route_of(hard_drive("roundabout").options, 60.0);
  const auto boxes = simulation::lay_out_open_land(route, 1);
  EXPECT_GT(boxes.size(), 40U);
  double t = 0.0;
  while (t < 60.0) {
    const Eigen::Vector2d p = route.at(t).position;
    for (const Box& box : boxes) {
      const Eigen::Vector2d nearest = p.cwiseMax(box.low.head<2>()).cwiseMin(box.high.head<2>());
      const double clear = box.kind == Box::Kind::kFarBuilding ? 100.0 : 2.0;
      EXPECT_GT((p - nearest).norm(), clear) << "at " << t << " s";
    }
    t += 0.2;
  }
}

TEST(Truck, KeepsItsGapOrSwingsIt) {
  SimulationOptions options = hard_drive("truck").options;
  for (const double swing : {0.0, 1.5}) {
    options.truck_gap_swing_m = swing;
    const Route route = route_of(options);
    const MovingVehicle truck = simulation::truck_ahead(options, route).front();
    double nearest = 1e9;
    double farthest = 0.0;
    double t = 0.0;
    while (t < 24.0) {
      const double camera = route.at(t).position.x() + options.camera_forward_m;
      nearest = std::min(nearest, truck.at(t).low.x() - camera);
      farthest = std::max(farthest, truck.at(t).low.x() - camera);
      t += 0.1;
    }
    EXPECT_NEAR(nearest, options.truck_gap_m - swing, 0.01);
    EXPECT_NEAR(farthest, options.truck_gap_m + swing, 0.01);
  }
}

TEST(TrafficAlongTheRoad, PassesBesideTheCar) {
  for (const char* name : {"overtaking", "oncoming"}) {
    const SimulationOptions options = hard_drive(name).options;
    const Route route = route_of(options);
    int passed = 0;
    for (const MovingVehicle& vehicle : simulation::traffic_of(options, route, 24.0)) {
      const bool behind_before = vehicle.at(0.0).low.x() < route.at(0.0).position.x();
      const bool behind_after = vehicle.at(24.0).low.x() < route.at(24.0).position.x();
      if (behind_before != behind_after) ++passed;
      EXPECT_GT(vehicle.at_start.low.y(), 2.0) << name;
    }
    EXPECT_GE(passed, 5) << name;
  }
}

TEST(TrafficAlongTheRoad, IsRefusedWhereTheRoadBends) {
  SimulationOptions options;
  options.traffic = Traffic::kTruck;
  EXPECT_THROW(options.validate(), std::invalid_argument);
  options.route = RouteKind::kStraight;
  EXPECT_NO_THROW(options.validate());
}

TEST(Buses, AreBeforeTheCameraOnlyWhileTheCarStands) {
  const SimulationOptions options = hard_drive("bus").options;
  const Route route = route_of(options, 40.0);
  const auto buses = simulation::crossing_buses(route);
  ASSERT_GE(buses.size(), 2U);
  int frames_before_it = 0;
  double t = 0.0;
  while (t < 24.0) {
    const Eigen::Vector2d car = route.at(t).position;
    for (const MovingVehicle& bus : buses) {
      const Box box = bus.at(t);
      const Eigen::Vector2d nearest = car.cwiseMax(box.low.head<2>()).cwiseMin(box.high.head<2>());
      if ((nearest - car).norm() > 7.0) continue;
      ++frames_before_it;
      EXPECT_EQ(route.at(t).speed, 0.0) << t;
    }
    t += 0.1;
  }
  EXPECT_GT(frames_before_it, 30);
}

TEST(OtherCameras, LookWhereTheirMountSays) {
  const auto axis = [](const char* name, int column) -> Eigen::Vector3d {
    SimulationOptions options = hard_drive(name).options;
    options.camera_tilt_deg = 0.0;
    return simulation::mount_of(options).linear().col(column);
  };
  EXPECT_NEAR(axis("rear", 2).x(), -1.0, 1e-12);
  EXPECT_NEAR(axis("left", 2).y(), 1.0, 1e-12);
  EXPECT_NEAR(axis("right", 2).y(), -1.0, 1e-12);
  EXPECT_NEAR(axis("upside-down", 1).z(), 1.0, 1e-12);  // the picture's down is up
  EXPECT_NEAR(axis("upside-down", 2).x(), 1.0, 1e-12);  // and ahead is ahead
  EXPECT_NEAR(axis("portrait", 0).z(), -1.0, 1e-12);    // right hangs down
}

}  // namespace
}  // namespace oneac
