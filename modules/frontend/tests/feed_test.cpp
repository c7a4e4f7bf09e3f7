#include "oneac/base/error.h"
#include "oneac/frontend/front_end.h"

#include <gtest/gtest.h>
#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationImage.h>

#include <cmath>
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
  // A wall that flickers: an image that repeats the one before would be passed over.
  observation->image = grey_image(static_cast<std::uint8_t>(70 + std::lround(10.0 * time_s) % 50));
  observation->cameraParams.setIntrinsicParamsFromValues(50.0, 51.0, 32.0, 24.0);
  observation->cameraParams.ncols = 64;
  observation->cameraParams.nrows = 48;
  observation->cameraPose = mrpt::poses::CPose3D(0.5, 0.0, 1.6, 0.0, 0.0, 0.0);  // x forward
  return observation;
}

TEST(FrontEndFeed, FollowsOneCameraInTimeOrder) {
  FrontEnd front_end{FrontEndOptions{}};
  front_end.logging_enable_console_output = false;
  front_end.logging_enable_keep_record = true;
  EXPECT_FALSE(front_end.feed(mrpt::obs::CObservationIMU::Create()).has_value());
  const auto first = front_end.feed(image_at(10.0, "cam"));
  ASSERT_TRUE(first.has_value());
  EXPECT_FALSE(first->step.has_value());
  EXPECT_FALSE(front_end.feed(image_at(10.1, "other")).has_value());
  EXPECT_FALSE(front_end.feed(image_at(9.9, "cam")).has_value());
  const auto second = front_end.feed(image_at(10.1, "cam"));
  ASSERT_TRUE(second.has_value());
  EXPECT_EQ(second->index, 2U);           // counts the image that came too late
  ASSERT_TRUE(second->step.has_value());  // a grey wall: nothing to see
  EXPECT_THROW(static_cast<void>(front_end.feed(nullptr)), std::invalid_argument);
  EXPECT_FALSE(front_end.feed(image_at(9.0, "cam")).has_value());
  EXPECT_EQ(front_end.fed().images, 2U);
  EXPECT_EQ(front_end.fed().of(PassedOver::kOutOfOrder), 2U);
  EXPECT_EQ(front_end.fed().of(PassedOver::kOtherSensor), 1U);
  const std::string log = front_end.getLogAsString();  // a line per reason
  const auto at = log.find(to_string(PassedOver::kOutOfOrder));
  ASSERT_NE(at, std::string::npos) << log;
  EXPECT_EQ(log.find(to_string(PassedOver::kOutOfOrder), at + 1), std::string::npos) << log;
}

TEST(FrontEndFeed, RefusesAnImageOfAnotherSizeAndGoesOn) {
  FrontEnd front_end{FrontEndOptions{}};
  static_cast<void>(front_end.feed(image_at(10.0, "cam")));
  const auto other = image_at(10.1, "cam");
  other->image = mrpt::img::CImage(32, 24, mrpt::img::CH_GRAY);
  EXPECT_THROW(static_cast<void>(front_end.feed(other)), InputError);
  EXPECT_TRUE(front_end.feed(image_at(10.2, "cam")).has_value());
}

TEST(FrontEndFeed, RefusesOptionsOfTheCameraOutOfBounds) {
  FrontEndOptions options;
  options.mount_convention = "sideways";
  EXPECT_THROW(FrontEnd{options}, std::invalid_argument);
  options = {};
  options.calibration = PinholeCamera{64, 48, -1.0, 50.0, 32.0, 24.0, {}};
  EXPECT_THROW(FrontEnd{options}, std::invalid_argument);
  for (const double fov : {-90.0, 9.0, 170.0, std::nan("")}) {
    options = {};
    options.undistorted_fov_deg = fov;
    EXPECT_THROW(FrontEnd{options}, std::invalid_argument) << fov;
  }
}

TEST(FrontEndReadings, AreRefusedWhenNoVehicleCanHaveThem) {
  FrontEnd front_end{FrontEndOptions{}};
  for (const double absurd : {std::nan(""), HUGE_VAL, 1e308, -1e308}) {
    EXPECT_THROW(front_end.add_speed(1.0, absurd), std::invalid_argument);
    EXPECT_THROW(front_end.add_speed(absurd, 1.0), std::invalid_argument);
    EXPECT_THROW(front_end.add_acceleration(absurd, {0, 0, 9.8}), std::invalid_argument);
    EXPECT_THROW(front_end.add_acceleration(1.0, {0, absurd, 9.8}), std::invalid_argument);
    EXPECT_THROW(front_end.add_acceleration(1.0, {0, 0, 9.8}, absurd), std::invalid_argument);
  }
  try {
    front_end.add_speed(1.0, -3.0);
    FAIL() << "a speed below 0";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "add_speed: speed_mps = -3, must be from 0 to 1000");
  }
  front_end.add_speed(1.0, 1000.0);
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
