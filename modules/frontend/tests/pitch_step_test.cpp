#include "pitch_step.h"

#include "oneac/geometry/leveling.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oneac {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// A step on a level road from a camera pitched by `pitch1` to one pitched by `pitch2`.
StepResult step_between(double pitch1, double pitch2, double roll, double yaw, double metres) {
  StepResult step;
  step.status = StepStatus::kOk;
  step.time2 = 0.1;
  step.metric = true;
  step.length = std::abs(metres);
  const Eigen::Matrix3d L1 = leveling_rotation({pitch1, roll});
  const Eigen::Matrix3d L2 = leveling_rotation({pitch2, roll});
  const Eigen::Matrix3d yawed = yaw_rotation(std::cos(yaw), std::sin(yaw));
  step.pose.R = L2.transpose() * yawed * L1;
  step.pose.t = L2.transpose() * Eigen::Vector3d(0.0, 0.0, -metres);
  return step;
}

TiltBelief tilt_of(double pitch, double roll, double roll_sigma = 0.0) {
  return {{pitch, roll}, 0.1 * kDegree, roll_sigma};
}

TEST(PitchStep, TellsTheTurnOfTheBodyFromTheTurnOfTheCar) {
  for (const double yaw : {0.0, 5.0 * kDegree}) {
    const StepResult step = step_between(2.0 * kDegree, 2.5 * kDegree, 1.0 * kDegree, yaw, 0.8);
    const PitchStep found = pitch_step(step, tilt_of(2.0 * kDegree, 1.0 * kDegree));
    EXPECT_NEAR(found.turn.angle, 0.5 * kDegree, 0.03 * kDegree) << yaw;
  }
}

TEST(PitchStep, MeasuresThePitchInTheMiddleOfTheStep) {
  for (const double metres : {0.8, -0.8}) {
    const StepResult step = step_between(2.0 * kDegree, 3.0 * kDegree, 0.0, 0.0, metres);
    const PitchStep found = pitch_step(step, tilt_of(1.0 * kDegree, 0.0));
    ASSERT_TRUE(found.travel.has_value()) << metres;
    EXPECT_NEAR(found.travel->angle, 2.5 * kDegree, 1e-6) << metres;
    EXPECT_DOUBLE_EQ(found.length, 0.8);
  }
}

TEST(PitchStep, IsLessSureOfASlowCarAndOfARollThatIsNotKnown) {
  const auto sigma = [](double metres) {
    return pitch_step(step_between(0.0, 0.0, 0.0, 0.0, metres), tilt_of(0.0, 0.0)).travel->sigma;
  };
  EXPECT_GT(sigma(0.1), 2.0 * sigma(1.0));
  const StepResult bend = step_between(0.0, 0.0, 0.0, 5.0 * kDegree, 0.8);
  EXPECT_GT(pitch_step(bend, tilt_of(0.0, 0.0, 1.0 * kDegree)).turn.sigma,
            2.0 * pitch_step(bend, tilt_of(0.0, 0.0)).turn.sigma);
}

TEST(PitchStep, SaysNothingOfTravelWhereThereIsNone) {
  StepResult step = step_between(0.0, 1.0 * kDegree, 0.0, 0.0, 0.0);
  step.status = StepStatus::kNoMotion;
  const PitchStep stands = pitch_step(step, tilt_of(0.0, 0.0));
  EXPECT_FALSE(stands.travel.has_value());
  EXPECT_EQ(stands.length, 0.0);
  EXPECT_NEAR(stands.turn.angle, 1.0 * kDegree, 1e-9);

  StepResult sideways = step_between(0.0, 0.0, 0.0, 0.0, 0.8);
  sideways.pose.t = {0.6, 0.0, -0.5};
  EXPECT_FALSE(pitch_step(sideways, tilt_of(0.0, 0.0)).travel.has_value());
}

}  // namespace
}  // namespace oneac
