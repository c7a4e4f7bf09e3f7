#include "oneac/rawlog/vehicle_reference.h"

#include <gtest/gtest.h>

#include <limits>

namespace oneac {
namespace {

constexpr double kDegree = M_PI / 180.0;

VehicleReference drive(const std::vector<double>& courses_deg, const std::vector<double>& speeds) {
  VehicleReference reference;
  for (std::size_t i = 0; i < courses_deg.size(); ++i) {
    reference.gps.push_back(
        {100.0 + static_cast<double>(i), std::nullopt, speeds[i], courses_deg[i] * kDegree});
  }
  return reference;
}

TEST(VehicleReference, TurningLeftIsPositiveAcrossNorth) {
  const auto reference = drive({20, 10, 0, 350, 340}, {5, 5, 5, 5, 5});
  ASSERT_TRUE(reference.heading_change(100, 104));
  EXPECT_NEAR(*reference.heading_change(100, 104), 40 * kDegree, 1e-12);
}

TEST(VehicleReference, InterpolatesTheCourseAtBothEnds) {
  const auto reference = drive({0, 10, 20, 30}, {5, 5, 5, 5});
  EXPECT_NEAR(*reference.heading_change(100.5, 102.25), -17.5 * kDegree, 1e-12);
}

TEST(VehicleReference, IgnoresTheCourseOfAStandingVehicle) {
  const auto reference = drive({10, 170, 300, 20}, {5, 0, 0.1, 5});
  EXPECT_NEAR(*reference.heading_change(100, 103), -10 * kDegree, 1e-12);
}

TEST(VehicleReference, SaysNothingWithoutCover) {
  const auto reference = drive({0, 10, 20, 30}, {5, 5, 5, 5});
  EXPECT_FALSE(reference.heading_change(98.0, 102.0));
  EXPECT_TRUE(reference.heading_change(98.6, 102.0));
  EXPECT_FALSE(reference.heading_change(100.0, 105.0));
  EXPECT_FALSE(reference.distance(100.0, 105.0));
  EXPECT_FALSE(reference.heading_change(103.0, 100.0));
  EXPECT_FALSE(reference.distance(std::numeric_limits<double>::quiet_NaN(), 102.0));
  EXPECT_FALSE(VehicleReference().heading_change(0.0, 1.0));
  EXPECT_FALSE(drive({10}, {5}).heading_change(100.0, 100.5));
}

TEST(VehicleReference, PlacesOfTwoLogsCompareWhateverTheirOriginsAndHeights) {
  const auto drive_from = [](double latitude, double altitude, double north) {
    VehicleReference reference;
    reference.origin = GeodeticFix{latitude, 8.4, altitude};
    for (int i = 0; i < 3; ++i) {
      reference.gps.push_back({100.0 + i, Eigen::Vector3d(0.0, north + 10.0 * i, 0.0), {}, {}});
    }
    return reference;
  };
  const double a_kilometre = 0.0089925;  // [deg] of latitude, at 49 degrees
  const auto first = drive_from(49.0, 0.0, 0.0);
  const auto second = drive_from(49.0 - a_kilometre, 545.0, 1000.0);
  ASSERT_TRUE(first.place(101.5) && second.place(101.5));
  EXPECT_NEAR((first.place(101.5)->point - first.place(100.5)->point).norm(), 10.0, 0.01);
  EXPECT_LT((first.place(101.5)->point - second.place(101.5)->point).norm(), 1.0);
  EXPECT_NEAR(first.place(101.5)->course.value(), 0.0, 1e-12);
  EXPECT_TRUE(first.place(102.0));
  EXPECT_FALSE(first.place(99.9));
  EXPECT_FALSE(first.place(102.1));
  auto gap = first;
  gap.gps[1].position_enu.reset();
  EXPECT_TRUE(gap.place(101.5));
  gap.gps[2].time_s += 4.0;
  EXPECT_FALSE(gap.place(101.5)) << "six seconds";
  EXPECT_FALSE(VehicleReference().place(100.0));
  auto creeping = first;
  creeping.gps[1].position_enu = Eigen::Vector3d(3.0, 0.0, 0.0);
  EXPECT_FALSE(creeping.place(100.5)->course);
  creeping.gps[1].position_enu = Eigen::Vector3d(6.0, 0.0, 0.0);
  EXPECT_NEAR(creeping.place(100.5)->course.value(), M_PI / 2, 1e-12);
}

TEST(VehicleReference, DoesNotBridgeALongGap) {
  auto reference = drive({0, 0, 0, 0}, {5, 5, 5, 5});
  reference.gps[2].time_s += 20.0;
  reference.gps[3].time_s += 20.0;
  EXPECT_FALSE(reference.distance(100.0, 123.0));
  EXPECT_FALSE(reference.heading_change(100.0, 123.0));
}

TEST(VehicleReference, IntegratesSpeedByTheTrapeziumRule) {
  const auto reference = drive({0, 0, 0}, {2, 4, 8});
  EXPECT_NEAR(*reference.distance(100, 102), 3 + 6, 1e-12);
  EXPECT_NEAR(*reference.distance(100.5, 101.5), 0.5 * 3.5 + 0.5 * 5.0, 1e-12);
  EXPECT_NEAR(*reference.distance(100.2, 100.4), 0.2 * 2.6, 1e-12);
}

}  // namespace
}  // namespace oneac
