#include "crossing_traffic.h"

#include "oneac/simulation/street_simulator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace oneac {
namespace {

SimulationOptions tiny_drive() {
  SimulationOptions options;
  options.width_px = 160;
  options.height_px = 120;
  options.focal_px = 125.0;
  options.image_noise = 0.0;
  return options;
}

double mean_grey(const GreyImage& image) {
  double sum = 0.0;
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) sum += image.row(v)[u];
  }
  return sum / (image.width() * image.height());
}

int pixels_that_differ(const GreyImage& a, const GreyImage& b) {
  int count = 0;
  for (int v = 0; v < a.height(); ++v) {
    for (int u = 0; u < a.width(); ++u) {
      if (std::abs(int{a.row(v)[u]} - int{b.row(v)[u]}) > 5) ++count;
    }
  }
  return count;
}

TEST(Slope, LiftsTheRoadAndLeavesTheImagesAsTheyAre) {
  SimulationOptions options = tiny_drive();
  const StreetSimulator level(options);
  options.slope_percent = 3.0;
  const StreetSimulator sloping(options);
  const std::size_t i = 20;  // still on the first street
  const Eigen::Vector3d travelled = sloping.state(i).T_world_vehicle.translation() -
                                    sloping.state(0).T_world_vehicle.translation();
  EXPECT_NEAR(travelled.z() / travelled.head<2>().norm(), 0.03, 1e-6);
  EXPECT_EQ(pixels_that_differ(level.frame(i).left, sloping.frame(i).left), 0);
}

TEST(Slope, IsFeltByTheAccelerometer) {
  SimulationOptions options = tiny_drive();
  options.slope_percent = 10.0;
  options.stop_s = 0.0;
  const StreetSimulator simulator(options);
  double x = 0.0;
  double z = 0.0;
  for (int k = 0; k < 50; ++k) {  // half a second at constant speed
    x += simulator.imu()[static_cast<std::size_t>(k)].specific_force_mps2.x();
    z += simulator.imu()[static_cast<std::size_t>(k)].specific_force_mps2.z();
  }
  EXPECT_NEAR(x / z, 0.10, 0.02);
}

TEST(DarkStretch, IsNearlyBlackAndEnds) {
  SimulationOptions options = tiny_drive();
  options.dark_from_s = 2.0;
  options.dark_s = 1.0;
  const StreetSimulator simulator(options);
  EXPECT_GT(mean_grey(simulator.frame(19).left), 50.0);
  EXPECT_LT(mean_grey(simulator.frame(20).left), 6.0);
  EXPECT_LT(mean_grey(simulator.frame(29).left), 6.0);
  EXPECT_GT(mean_grey(simulator.frame(30).left), 50.0);
}

TEST(CrossingTraffic, PassesBeforeTheCamera) {
  SimulationOptions options = tiny_drive();
  const StreetSimulator empty(options);
  options.traffic = Traffic::kCrossing;
  const StreetSimulator busy(options);
  int frames_with_traffic = 0;
  for (std::size_t i = 0; i < 60; i += 2) {
    const int pixels = pixels_that_differ(empty.frame(i).left, busy.frame(i).left);
    if (pixels > 100) ++frames_with_traffic;
    EXPECT_LT(pixels, 160 * 120 / 3) << "frame " << i;
  }
  EXPECT_GE(frames_with_traffic, 3);
}

TEST(CrossingTraffic, NeverComesNearTheCar) {
  const SimulationOptions options = tiny_drive();
  const simulation::Route route(options, 24.0);
  for (const auto& vehicle : simulation::crossing_traffic(route, 24.0)) {
    double t = 0.0;
    while (t < 24.0) {
      const simulation::Box box = vehicle.at(t);
      const Eigen::Vector2d car = route.at(t).position;
      const Eigen::Vector2d nearest = car.cwiseMax(box.low.head<2>()).cwiseMin(box.high.head<2>());
      EXPECT_GT((car - nearest).norm(), 4.0) << "at " << t << " s";
      t += 0.1;
    }
  }
}

}  // namespace
}  // namespace oneac
