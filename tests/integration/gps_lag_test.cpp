#include "run/gps_lag.h"

#include "terminal/progress_bar.h"
#include "turning_vehicle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace oneac::app {
namespace {

constexpr double kStart = 1.26e9;

/// Straight, a bend of 90° to the left within three seconds, straight.
double heading(double t) {
  return std::clamp((t - 12.0) / 3.0, 0.0, 1.0) * M_PI / 2.0;
}

Trajectory vehicle() {
  return turning_vehicle(kStart, heading);
}

VehicleReference gps(double lag, bool bend = true) {
  VehicleReference reference;
  for (int i = -40; i < 80; ++i) {
    GpsFix fix;
    fix.time_s = kStart + i + lag;
    fix.speed = 8.0;
    fix.course = bend ? -heading(i) : 0.0;
    reference.gps.push_back(fix);
  }
  return reference;
}

TEST(GpsLag, IsFoundByTheBendWhicheverClockIsLate) {
  for (const double lag : {0.5, -0.5, 2.0, 18.0, -18.0}) {
    const auto found = lag_of_gps(vehicle(), gps(lag));
    ASSERT_TRUE(found) << lag;
    EXPECT_NEAR(*found, lag, 0.2);
  }
  EXPECT_NE(about_lag(0.52).find("0.5 s too late"), std::string::npos);
  EXPECT_NE(about_lag(-18.0).find("18.0 s too early"), std::string::npos);
}

TEST(GpsLag, IsNoneWhereClocksAgreeOrNothingTells) {
  EXPECT_FALSE(lag_of_gps(vehicle(), gps(0.0)));
  EXPECT_FALSE(lag_of_gps(vehicle(), gps(0.1)));
  EXPECT_FALSE(lag_of_gps(vehicle(), gps(0.5, false)));
  EXPECT_FALSE(lag_of_gps(vehicle(), {}));
  EXPECT_FALSE(lag_of_gps({}, gps(0.5)));
}

TEST(ProgressText, TellsThingsOfThingsRateAndTimeLeft) {
  EXPECT_EQ(progress_text({100, 400, 0.25, 10.0}, "frames", 80),
            "[#######.......................] 100 of 400 frames, 10.0/s, 0:30 left");
  EXPECT_EQ(progress_text({7, 0, 0.5, 2.0}, "pairs", 40),
            "[###########............] 7 pairs, 3.5/s");
  EXPECT_NE(progress_text({1, 100000, 0.0, 1.0}, "frames", 80).find("27:46:39 left"),
            std::string::npos);
}

TEST(ProgressText, FitsEveryWidth) {
  for (std::size_t columns = 1; columns < 120; ++columns) {
    for (const Progress& progress :
         {Progress{0, 400, 0.0, 0.0}, Progress{399, 400, 0.9975, 1e9},
          Progress{500, 400, 1.25, 1.0}, Progress{12345678, 0, 0.3, 1e-9}}) {
      EXPECT_LE(progress_text(progress, "frames", columns).size(), columns);
    }
  }
  EXPECT_EQ(progress_text({4, 400, 0.01, 1.0}, "frames", 18), "4 of 400 frames");
}

}  // namespace
}  // namespace oneac::app
