#include "two_view/turn_gate.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace oneac {
namespace {

Eigen::Matrix3d yaw(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()).toRotationMatrix();
}

TEST(TurnGate, AllowsABendThatBeginsAndEnds) {
  TurnGate gate;
  for (int i = 0; i < 40; ++i) {
    const double rate = i < 20 ? 0.04 * i : 0.04 * (40 - i);  // up to 46° a second
    EXPECT_TRUE(gate.allows(yaw(0.1 * rate), 0.1 * i, 0.1 * (i + 1))) << i;
  }
}

TEST(TurnGate, RefusesAJumpOfTheRateThatNoVehicleMakes) {
  TurnGate gate;
  EXPECT_TRUE(gate.allows(yaw(0.001), 0.0, 0.1));
  EXPECT_FALSE(gate.allows(yaw(0.135), 0.1, 0.2)) << "77° a second at once";
  EXPECT_TRUE(gate.allows(yaw(0.002), 0.2, 0.3)) << "and keeps what it knew";
}

TEST(TurnGate, GivesInToWhatStays) {
  TurnGate gate;
  EXPECT_TRUE(gate.allows(yaw(0.2), 0.0, 0.1));
  int refused = 0;
  for (int i = 1; i < 20; ++i) refused += gate.allows(yaw(0.0), 0.1 * i, 0.1 * (i + 1)) ? 0 : 1;
  EXPECT_LE(refused, 10) << "a second";
}

TEST(TurnGate, SaysNothingAfterAGap) {
  TurnGate gate;
  EXPECT_TRUE(gate.allows(yaw(0.0), 0.0, 0.1));
  EXPECT_TRUE(gate.allows(yaw(1.0), 5.0, 6.0));
  EXPECT_TRUE(gate.allows(yaw(1.0), 6.0, 6.0)) << "no time, no rate";
}

}  // namespace
}  // namespace oneac
