#include "oneac/calibration/turn_spans.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oneac {
namespace {

/// 20 s at 10 Hz with a bend of 1.5 rad from 8 s to 11 s.
double heading_at(double t) {
  return t < 8.0 ? 0.0 : t < 11.0 ? 0.5 * (t - 8.0) : 1.5;
}

void drive(TurnSpanCutter& cutter, Heading& sensor, double lost_at = -1.0) {
  for (int i = 0; i <= 200; ++i) {
    const double t = 0.1 * i;
    const bool carried = std::abs(t - lost_at) > 0.05;
    cutter.add_frame(t, heading_at(t) - heading_at(t - 0.1), carried);
    sensor.add(t, heading_at(t));
    static_cast<void>(cutter.cut(sensor));
  }
}

TEST(TurnSpanCutter, ABendIsOneSpanBetweenStraights) {
  TurnSpanCutter cutter = TurnSpanCutter::for_gyroscope();
  Heading sensor(1.0);
  drive(cutter, sensor);
  int bends = 0;
  for (const TurnSpan& span : cutter.spans()) {
    EXPECT_NEAR(span.by_images, span.by_sensor, 1e-9);
    EXPECT_GE(span.duration, 2.0 - 1e-9);
    if (std::abs(span.by_images) < 0.1) continue;
    ++bends;
    EXPECT_NEAR(span.by_images, 1.5, 1e-6);
  }
  EXPECT_EQ(bends, 1);
}

TEST(TurnSpanCutter, ABendThatImagesLostIsLeftOut) {
  TurnSpanCutter cutter = TurnSpanCutter::for_gyroscope();
  Heading sensor(1.0);
  drive(cutter, sensor, 9.5);
  for (const TurnSpan& span : cutter.spans()) EXPECT_NEAR(span.by_images, 0.0, 0.05);
}

TEST(TurnSpanCutter, TheSameSpansWhetherTheSensorComesAtOnceOrAsItGoes) {
  TurnSpanCutter live = TurnSpanCutter::for_gyroscope(), after = live;
  Heading live_sensor(1.0), after_sensor(1.0);
  drive(live, live_sensor);
  for (int i = 0; i <= 200; ++i) {
    const double t = 0.1 * i;
    after.add_frame(t, heading_at(t) - heading_at(t - 0.1), true);
    after_sensor.add(t, heading_at(t));
  }
  EXPECT_EQ(after.cut(after_sensor), live.spans().size());
}

TEST(TurnSpanCutter, ACourseOfOneFixASecondThatIsLateStillSeesTheWholeBend) {
  TurnSpanCutter cutter = TurnSpanCutter::for_course();
  Heading sensor(1.5);
  for (int i = 0; i <= 20; ++i) sensor.add(i, heading_at(i - 0.7));
  for (int i = 0; i <= 200; ++i) {
    cutter.add_frame(0.1 * i, heading_at(0.1 * i) - heading_at(0.1 * (i - 1)), true);
  }
  static_cast<void>(cutter.cut(sensor));
  double turned = 0.0;
  for (const TurnSpan& span : cutter.spans()) {
    EXPECT_NEAR(span.by_images, span.by_sensor, 1e-9);
    turned += span.by_images;
  }
  EXPECT_NEAR(turned, 1.5, 1e-6);
}

TEST(CourseHeading, IsNotKnownWhereTheVehicleIsSlow) {
  CourseHeading course;
  for (int i = 0; i < 10; ++i) course.add(i, i < 5 ? 0.0 : -0.5, i == 5 ? 0.5 : 8.0);
  EXPECT_FALSE(course.heading().turn(2.0, 8.0));
  EXPECT_TRUE(course.heading().turn(6.5, 8.0));
}

TEST(GyroscopeHeading, AddsRatesUpAndStopsAtAGap) {
  GyroscopeHeading gyroscope;
  for (int i = 0; i <= 100; ++i) gyroscope.add(0.01 * i, 0.5);
  EXPECT_NEAR(*gyroscope.heading().turn(0.105, 0.905), 0.4, 1e-9);
  gyroscope.add(2.0, 0.5);
  gyroscope.add(2.1, 0.5);
  EXPECT_FALSE(gyroscope.heading().turn(0.5, 2.05));
}

}  // namespace
}  // namespace oneac
