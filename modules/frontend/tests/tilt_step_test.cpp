#include "attitude/tilt_step.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>

namespace oneac {
namespace {

StepResult step_of(double metres, double seconds) {
  StepResult step;
  step.status = StepStatus::kOk;
  step.time2 = seconds;
  step.metric = true;
  step.length = metres;
  step.pose.R = Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY()).toRotationMatrix();
  step.pose.t = Eigen::Vector3d(0.0, 0.03, -0.4);
  return step;
}

TEST(TiltStep, HasTheTurnAndTheDirectionOfTravel) {
  const StepResult step = step_of(0.8, 0.1);
  const TiltStep found = tilt_step(step);
  EXPECT_EQ(found.R_2_1, step.pose.R);
  EXPECT_DOUBLE_EQ(found.length, 0.8);
  EXPECT_DOUBLE_EQ(found.seconds, 0.1);
  ASSERT_TRUE(found.travel.has_value());
  EXPECT_NEAR(found.travel->direction.norm(), 1.0, 1e-12);
  EXPECT_NEAR(found.travel->direction.cross(step.pose.t).norm(), 0.0, 1e-12);
}

TEST(TiltStep, IsLessSureOfASlowCar) {
  EXPECT_GT(tilt_step(step_of(0.1, 0.1)).travel->sigma,
            2.0 * tilt_step(step_of(1.0, 0.1)).travel->sigma);
}

TEST(TiltStep, SaysHowWellTheImagesKnowTheDirection) {
  StepResult step = step_of(0.8, 0.1);
  step.covariance.setZero();
  step.covariance(4, 4) = 0.01 * 0.01 * step.pose.t.squaredNorm();  // 0.01 rad upwards
  const TiltStep found = tilt_step(step);
  ASSERT_TRUE(found.travel.has_value());
  EXPECT_NEAR(found.travel->covariance(1, 1), 1e-4, 1e-9);
  EXPECT_EQ(found.travel->covariance(2, 2), 0.0);
}

TEST(TiltStep, SaysNothingOfTravelWhereThereIsNone) {
  StepResult step = step_of(0.0, 0.1);
  step.status = StepStatus::kNoMotion;
  step.pose.t.setZero();
  const TiltStep stands = tilt_step(step);
  EXPECT_FALSE(stands.travel.has_value());
  EXPECT_EQ(stands.length, 0.0);
  EXPECT_EQ(stands.R_2_1, step.pose.R) << "a body rocks on when the car has stopped";
  EXPECT_FALSE(tilt_step(step_of(0.0, 0.1)).travel.has_value()) << "at no speed";
}

}  // namespace
}  // namespace oneac
