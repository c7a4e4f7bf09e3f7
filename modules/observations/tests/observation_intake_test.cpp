#include "oneac/observations/observation_intake.h"

#include "log_maker.h"

#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationIMU.h>

#include <opencv2/imgcodecs.hpp>

namespace oneac {
namespace {

IntakeOptions following(const std::string& camera) {
  IntakeOptions options;
  options.camera = camera;
  return options;
}

/// @throws std::bad_optional_access when the observation gives none
CameraFrame frame_of(ObservationIntake& intake, const mrpt::obs::CObservation& observation) {
  return intake.take(observation).frame.value();
}

TEST(ObservationIntake, MakesAFrameOfAnImage) {
  ObservationIntake intake({});
  const auto frame = frame_of(intake, *test::stored_image("CAM", 2.0, test::ramp(40)));
  EXPECT_NEAR(frame.time_s, test::kStart + 2.0, 1e-6);
  EXPECT_EQ(frame.image.row(20)[30], 70);
  EXPECT_EQ(frame.camera.width, test::kWidth);
  EXPECT_NEAR(frame.T_vehicle_cam.linear()(0, 2), 1.0, 1e-12);  // x forward in the log
  EXPECT_EQ(intake.counts().images, 1U);
}

TEST(ObservationIntake, FollowsTheFirstCameraOrTheOneAskedFor) {
  ObservationIntake first({}), second(following("B"));
  const auto a = test::stored_image("A", 0, test::ramp(0));
  const auto b = test::stored_image("B", 0, test::ramp(0));
  EXPECT_TRUE(first.take(*a).frame);
  EXPECT_EQ(first.take(*b).passed_over, PassedOver::kOtherSensor);
  EXPECT_EQ(second.take(*a).passed_over, PassedOver::kOtherSensor);
  EXPECT_TRUE(second.take(*b).frame);
}

TEST(ObservationIntake, TakesEitherHalfOfAPair) {
  const TemporaryFolder folder;
  const std::string base = (folder.path() / "a").string();
  cv::imwrite(base + "_left.png", test::ramp(10));
  cv::imwrite(base + "_right.png", test::ramp(20));
  const auto pair = test::external_pair("PAIR", 0, base);
  ObservationIntake left({}), right(following("right"));
  EXPECT_EQ(frame_of(left, *pair).image.row(0)[0], 10);
  const auto frame = frame_of(right, *pair);
  EXPECT_EQ(frame.image.row(0)[0], 20);
  EXPECT_EQ(frame.name, "a_right.png");
  IntakeOptions options;
  options.reader.stereo = true;
  ObservationIntake both(options);
  const auto stereo = frame_of(both, *pair);
  EXPECT_EQ(stereo.right.row(0)[0], 20);
  EXPECT_NEAR(stereo.baseline_m, 0.12, 1e-12);
}

TEST(ObservationIntake, KeepsTheGreyLevelsOfADrive) {
  cv::Mat day, night;
  test::ramp(150).convertTo(day, CV_16U, 16.0);
  test::ramp(10).convertTo(night, CV_16U, 8.0);
  ObservationIntake intake({});
  EXPECT_EQ(frame_of(intake, *test::stored_image("CAM", 0.0, day)).image.row(0)[40], 190);
  EXPECT_EQ(frame_of(intake, *test::stored_image("CAM", 1.0, night)).image.row(0)[40], 25);
}

TEST(ObservationIntake, TakesMasksAlongWithTheImages) {
  const TemporaryFolder folder;
  const std::string base = (folder.path() / "a").string();
  cv::imwrite(base + "_left.png", test::ramp(10));
  cv::imwrite(base + "_right.png", test::ramp(20));
  GreyImage left(test::kWidth, test::kHeight, 255), right(test::kWidth, test::kHeight, 255);
  left.row(3)[4] = 0;
  right.row(5)[6] = 0;
  IntakeOptions options;
  options.reader.stereo = true;
  ObservationIntake intake(options);
  const auto pair = test::external_pair("PAIR", 0, base);
  const CameraFrame frame = intake.take(*pair, {left.view(), right.view()}).frame.value();
  ASSERT_EQ(frame.mask.width(), test::kWidth);
  ASSERT_EQ(frame.right_mask.height(), test::kHeight);
  EXPECT_EQ(frame.mask.row(3)[4], 0);
  EXPECT_EQ(frame.mask.row(5)[6], 255);
  EXPECT_EQ(frame.right_mask.row(5)[6], 0);
  cv::imwrite(base + "_left.png", test::ramp(11));  // one that repeats would be passed over
  EXPECT_TRUE(frame_of(intake, *test::external_pair("PAIR", 1, base)).mask.empty());
}

TEST(ObservationIntake, RefusesAMaskOfAnotherSizeOrOfOnesAndGoesOn) {
  ObservationIntake intake({});
  const GreyImage small(20, 10, 255), ones(test::kWidth, test::kHeight, 1);
  const auto image = test::stored_image("CAM", 0.0, test::ramp(0));
  EXPECT_THROW(static_cast<void>(intake.take(*image, {small.view(), {}})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(intake.take(*image, {ones.view(), {}})), std::invalid_argument);
  EXPECT_TRUE(intake.take(*image).frame);
}

TEST(ObservationIntake, CountsWhatItPassesOverByReason) {
  ObservationIntake intake({});
  EXPECT_TRUE(intake.take(*test::stored_image("CAM", 1.0, test::ramp(0))).frame);
  const auto reason = [&](const mrpt::obs::CObservation& o) { return intake.take(o).passed_over; };
  EXPECT_EQ(reason(mrpt::obs::CObservationComment()), PassedOver::kOtherClass);
  EXPECT_EQ(reason(*test::external_image("CAM", 2.0, "nowhere.png")), PassedOver::kMissing);
  EXPECT_EQ(reason(*test::stored_image("CAM", 0.5, test::ramp(0))), PassedOver::kOutOfOrder);
  EXPECT_EQ(reason(*test::gga(0.0, 36.0, -4.0, 1.0)), PassedOver::kNotNeeded);
  mrpt::obs::CObservationIMU imu;
  imu.timestamp = INVALID_TIMESTAMP;
  EXPECT_EQ(reason(imu), PassedOver::kUnstamped);
  imu.timestamp = mrpt::Clock::fromDouble(test::kStart);  // and no field is set
  EXPECT_EQ(reason(imu), PassedOver::kUnusable);
  EXPECT_EQ(reason(*test::stored_image("CAM", 2.5, test::ramp(0))), PassedOver::kRepeated);
  for (const PassedOver one : {PassedOver::kOtherClass, PassedOver::kMissing, PassedOver::kRepeated,
                               PassedOver::kUnstamped}) {
    EXPECT_EQ(intake.counts().of(one), 1U) << to_string(one);
  }
  // Missing ones, late ones and repeated ones count as images of the camera.
  EXPECT_EQ(frame_of(intake, *test::stored_image("CAM", 3.0, test::ramp(1))).index, 4U);
}

TEST(ObservationIntake, GoesOnAfterARefusal) {
  ObservationIntake intake({});
  const auto bad = test::stored_image("CAM", 0.0, test::ramp(0));
  bad->cameraParams.fx(0.0);
  EXPECT_THROW(static_cast<void>(intake.take(*bad)), InputError);
  EXPECT_EQ(frame_of(intake, *test::stored_image("CAM", 0.1, test::ramp(0))).index, 1U);
  const auto unstamped = test::stored_image("CAM", 0.2, test::ramp(0));
  unstamped->timestamp = INVALID_TIMESTAMP;
  EXPECT_THROW(static_cast<void>(intake.take(*unstamped)), InputError);
  EXPECT_TRUE(intake.take(*test::stored_image("CAM", 0.3, test::ramp(1))).frame);
}

TEST(ObservationIntake, GivesASpeedTheTimeOfItsEpoch) {
  ObservationIntake intake({});
  EXPECT_FALSE(intake.take(*test::gga(1.0, 36.0, -4.0, 1.0)).speed);
  const auto speed = intake.take(*test::rmc(1.2, 10.0, 0.0)).speed;
  ASSERT_TRUE(speed);
  EXPECT_NEAR(speed->time_s, test::kStart + 1.0, 1e-6);
  EXPECT_NEAR(speed->speed, 5.144, 1e-3);
  EXPECT_EQ(speed->sigma, SpeedReading::kDoppler);
  const auto other = test::rmc(2.0, 10.0, 0.0);
  other->sensorLabel = "SPARE";
  EXPECT_EQ(intake.take(*other).passed_over, PassedOver::kOtherSensor);
}

TEST(ObservationIntake, GivesTheCourseWithItsSpeedAndRatesWithoutAcceleration) {
  ObservationIntake intake({});
  EXPECT_FALSE(intake.take(*test::gga(1.0, 36.0, -4.0, 1.0)).course);
  const auto course = intake.take(*test::rmc(1.2, 10.0, 90.0)).course;
  ASSERT_TRUE(course);
  EXPECT_NEAR(course->time_s, test::kStart + 1.2, 1e-6);
  EXPECT_NEAR(course->course, M_PI / 2, 1e-9);
  EXPECT_NEAR(course->speed, 5.144, 1e-3);
  mrpt::obs::CObservationIMU gyroscope;
  gyroscope.timestamp = mrpt::Clock::fromDouble(test::kStart);
  for (const auto rate : {mrpt::obs::IMU_WX, mrpt::obs::IMU_WY, mrpt::obs::IMU_WZ}) {
    gyroscope.set(rate, 0.25);
  }
  const auto inertial = intake.take(gyroscope).inertial;
  ASSERT_TRUE(inertial && inertial->angular_rate);
  EXPECT_FALSE(inertial->acceleration);
  EXPECT_EQ(inertial->angular_rate->z(), 0.25);
}

TEST(ObservationIntake, ALoneGyroscopeTakesNoImusPlace) {
  ObservationIntake intake({});
  const auto reading = [](const char* label, double seconds, bool feels) {
    mrpt::obs::CObservationIMU imu;
    imu.sensorLabel = label;
    imu.timestamp = mrpt::Clock::fromDouble(test::kStart + seconds);
    for (const auto rate : {mrpt::obs::IMU_WX, mrpt::obs::IMU_WY, mrpt::obs::IMU_WZ}) {
      imu.set(rate, 0.25);
    }
    if (!feels) return imu;
    for (const auto axis : {mrpt::obs::IMU_X_ACC, mrpt::obs::IMU_Y_ACC, mrpt::obs::IMU_Z_ACC}) {
      imu.set(axis, 5.0);
    }
    return imu;
  };
  EXPECT_TRUE(intake.take(reading("GYRO", 0.0, false)).inertial);
  const auto felt = intake.take(reading("IMU", 0.1, true)).inertial;
  ASSERT_TRUE(felt && felt->acceleration && felt->angular_rate);
  EXPECT_EQ(intake.take(reading("GYRO", 0.2, false)).passed_over, PassedOver::kOtherSensor);
}

TEST(ObservationIntake, GivesASpeedByPositionsAlone) {
  ObservationIntake intake({});
  EXPECT_EQ(intake.take(*test::gga(1.0, 36.7, -4.4, 1.0)).passed_over, PassedOver::kNotNeeded);
  const auto speed = intake.take(*test::gga(2.0, 36.7001, -4.4, 1.0)).speed;
  ASSERT_TRUE(speed);
  EXPECT_NEAR(speed->speed, 11.097, 0.01);
  EXPECT_EQ(intake.counts().speeds, 1U);
}

}  // namespace
}  // namespace oneac
