#include "oneac/comparison/given_tilt.h"

#include <gtest/gtest.h>

namespace oneac {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// Translation of a camera with this tilt on a vehicle that drives straight on, or back.
Eigen::Vector3d driving(const Tilt& tilt, double step) {
  return levelling_rotation(tilt).transpose() * Eigen::Vector3d(0.0, 0.0, -step);
}

TEST(CorrectedByTravel, FindsTheTruePitch) {
  const Tilt truth{7.0 * kDegree, 1.0 * kDegree};
  const Tilt given{6.0 * kDegree, 1.0 * kDegree};
  const Tilt found =
      corrected_by_travel(given, {driving(truth, 1.0), driving(truth, -2.0), driving(truth, 0.5)});
  EXPECT_NEAR(found.pitch_up, truth.pitch_up, 1e-3);
  EXPECT_EQ(found.roll_right, given.roll_right);
}

TEST(CorrectedByTravel, IgnoresStandingSideStepsAndClimbs) {
  const Tilt given{2.0 * kDegree, 0.0};
  const Tilt found =
      corrected_by_travel(given, {Eigen::Vector3d::Zero(), {1.0, 0.0, 0.0}, {0.0, 1.0, -1.0}});
  EXPECT_EQ(found.pitch_up, given.pitch_up);
}

TEST(GivenTilt, IsTheMountingUnlessAnglesAreGiven) {
  Eigen::Matrix3d ahead;
  ahead << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const GivenTilt log;
  EXPECT_NEAR(log.tilt(ahead).pitch_up, 0.0, 1e-12);
  const GivenTilt params{"params", 5.0, -1.0, true};
  EXPECT_NEAR(params.tilt(ahead).pitch_up, 5.0 * kDegree, 1e-12);
  EXPECT_NEAR(params.tilt(ahead).roll_right, -1.0 * kDegree, 1e-12);
}

}  // namespace
}  // namespace oneac
