#include "oneac/frontend/observation_input.h"

#include "oneac/base/error.h"
#include "oneac/frontend/front_end.h"

#include <gtest/gtest.h>
#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <cmath>
#include <cstring>
#include <stdexcept>

namespace oneac {
namespace {

mrpt::img::CImage grey_image(std::uint8_t value) {
  mrpt::img::CImage image(64, 48, mrpt::img::CH_GRAY);
  for (unsigned row = 0; row < 48; ++row) {
    auto* pixels = image.ptrLine<std::uint8_t>(row);
    for (int column = 0; column < 64; ++column) pixels[column] = value;
  }
  return image;
}

mrpt::obs::CObservationImage::Ptr image_at(double time_s, const std::string& label) {
  auto observation = mrpt::obs::CObservationImage::Create();
  observation->timestamp = mrpt::Clock::fromDouble(time_s);
  observation->sensorLabel = label;
  observation->image = grey_image(77);
  observation->cameraParams.setIntrinsicParamsFromValues(50.0, 51.0, 32.0, 24.0);
  observation->cameraPose = mrpt::poses::CPose3D(0.5, 0.0, 1.6, 0.0, 0.0, 0.0);  // x forward
  return observation;
}

TEST(ObservationInput, MakesAFrameOfAnImage) {
  const auto frame = frame_from_observation(*image_at(10.0, "cam"));
  ASSERT_TRUE(frame.has_value());
  EXPECT_NEAR(frame->time_s, 10.0, 1e-6);
  EXPECT_EQ(frame->image.width(), 64);
  EXPECT_EQ(frame->image.row(20)[30], 77);
  EXPECT_DOUBLE_EQ(frame->camera.fy, 51.0);
  // The log's axes were X forward: the optical axis looks along the vehicle's X.
  EXPECT_NEAR(frame->T_vehicle_cam.linear()(0, 2), 1.0, 1e-12);
  EXPECT_NEAR(frame->T_vehicle_cam.translation().z(), 1.6, 1e-12);
}

TEST(ObservationInput, TakesTheLeftImageOfAPair) {
  mrpt::obs::CObservationStereoImages pair;
  pair.imageLeft = grey_image(10);
  pair.imageRight = grey_image(20);
  pair.leftCamera.setIntrinsicParamsFromValues(50.0, 50.0, 32.0, 24.0);
  const auto frame = frame_from_observation(pair);
  ASSERT_TRUE(frame.has_value());
  EXPECT_EQ(frame->image.row(5)[5], 10);
}

TEST(ObservationInput, RefusesAnImageWithoutCalibration) {
  auto observation = image_at(10.0, "cam");
  observation->cameraParams.setIntrinsicParamsFromValues(0.0, 0.0, 0.0, 0.0);
  EXPECT_THROW(static_cast<void>(frame_from_observation(*observation)), InputError);
}

TEST(ObservationInput, TurnsAccelerationsIntoTheVehicleFrame) {
  mrpt::obs::CObservationIMU imu;
  EXPECT_FALSE(acceleration_from_observation(imu).has_value());
  imu.sensorPose = mrpt::poses::CPose3D(0.0, 0.0, 0.0, 0.0, 0.0, M_PI / 2.0);  // rolled by 90°
  imu.set(mrpt::obs::IMU_X_ACC, 0.0);
  imu.set(mrpt::obs::IMU_Y_ACC, 9.8);
  imu.set(mrpt::obs::IMU_Z_ACC, 0.0);
  const auto acceleration = acceleration_from_observation(imu);
  ASSERT_TRUE(acceleration.has_value());
  EXPECT_NEAR(acceleration->z(), 9.8, 1e-9);
  EXPECT_FALSE(yaw_rate_from_observation(imu).has_value());
  imu.set(mrpt::obs::IMU_WX, 0.0);
  imu.set(mrpt::obs::IMU_WY, 0.3);
  imu.set(mrpt::obs::IMU_WZ, 0.0);
  EXPECT_NEAR(yaw_rate_from_observation(imu).value(), 0.3, 1e-9);
}

// As a damaged log has them: MRPT copies the bytes.
TEST(ObservationInput, TakesADamagedFlagForNotSet) {
  mrpt::obs::CObservationIMU imu;
  for (const auto field : {mrpt::obs::IMU_WX, mrpt::obs::IMU_WY, mrpt::obs::IMU_WZ}) {
    imu.set(field, 0.1);
  }
  std::memset(&imu.dataIsPresent[mrpt::obs::IMU_WY], 2, 1);
  EXPECT_FALSE(yaw_rate_from_observation(imu).has_value());
}

TEST(ObservationInput, ReadsTheSpeedOfAValidRmcMessage) {
  mrpt::obs::CObservationGPS gps;
  EXPECT_FALSE(speed_from_observation(gps).has_value());
  mrpt::obs::gnss::Message_NMEA_RMC rmc;
  rmc.fields.speed_knots = 10.0;
  rmc.fields.validity_char = 'A';
  gps.setMsg(rmc);
  EXPECT_NEAR(speed_from_observation(gps).value(), 5.144, 1e-3);
  rmc.fields.validity_char = 'V';
  gps.setMsg(rmc);
  EXPECT_FALSE(speed_from_observation(gps).has_value());
}

TEST(FrontEndFeed, FollowsOneCameraInTimeOrder) {
  FrontEnd front_end{FrontEndOptions{}};
  EXPECT_FALSE(front_end.feed(mrpt::obs::CObservationIMU::Create()).has_value());
  const auto first = front_end.feed(image_at(10.0, "cam"));
  ASSERT_TRUE(first.has_value());
  EXPECT_FALSE(first->step.has_value());
  EXPECT_FALSE(front_end.feed(image_at(10.1, "other")).has_value());
  EXPECT_FALSE(front_end.feed(image_at(9.9, "cam")).has_value());
  const auto second = front_end.feed(image_at(10.1, "cam"));
  ASSERT_TRUE(second.has_value());
  EXPECT_EQ(second->index, 1U);
  ASSERT_TRUE(second->step.has_value());  // a grey wall: nothing to see
  EXPECT_THROW(static_cast<void>(front_end.feed(nullptr)), std::invalid_argument);
}

TEST(FrontEndFeed, LevelsByTheAccelerometer) {
  FrontEndOptions options;
  options.tilt.source = "imu";
  FrontEnd front_end(options);
  const double pitch = 0.1;  // nose of the vehicle up
  for (int i = 0; i < 20; ++i) {
    front_end.add_acceleration(30.0 * i, {9.8 * std::sin(pitch), 0.0, 9.8 * std::cos(pitch)});
  }
  static_cast<void>(front_end.feed(image_at(10.0, "cam")));
  EXPECT_NEAR(front_end.tilt().pitch_up, pitch, 0.01 * pitch);  // ten minutes
  EXPECT_GT(front_end.tilt_belief().pitch_sigma, 0.0);
}

}  // namespace
}  // namespace oneac
