#include "oneac/observations/sensor_readings.h"

#include "log_maker.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationIMU.h>

#include <cmath>
#include <cstring>

namespace oneac {
namespace {

using mrpt::obs::CObservationIMU;

CObservationIMU imu(double x, double y, double z) {
  CObservationIMU observation;
  observation.timestamp = mrpt::Clock::fromDouble(test::kStart);
  observation.set(mrpt::obs::IMU_X_ACC, x);
  observation.set(mrpt::obs::IMU_Y_ACC, y);
  observation.set(mrpt::obs::IMU_Z_ACC, z);
  return observation;
}

TEST(ImuSample, IsTurnedIntoTheVehicleFrame) {
  CObservationIMU observation = imu(0.0, 9.8, 0.0);
  observation.sensorPose = mrpt::poses::CPose3D(0, 0, 0, 0, 0, M_PI / 2);  // rolled by 90°
  const auto sample = imu_sample(observation);
  ASSERT_TRUE(sample && sample->acceleration);
  EXPECT_NEAR(sample->acceleration->z(), 9.8, 1e-9);
  EXPECT_FALSE(sample->angular_rate);
  observation.set(mrpt::obs::IMU_WX, 0.0);
  observation.set(mrpt::obs::IMU_WY, 0.3);
  observation.set(mrpt::obs::IMU_WZ, 0.0);
  EXPECT_NEAR(imu_sample(observation)->angular_rate->z(), 0.3, 1e-9);
}

TEST(ImuSample, IsEmptyWithoutStampAndForAbsurdNumbers) {
  CObservationIMU observation = imu(0.0, 0.0, 9.8);
  observation.timestamp = INVALID_TIMESTAMP;
  EXPECT_FALSE(imu_sample(observation));
  for (const double absurd : {std::nan(""), HUGE_VAL, 1e308, -1e4}) {
    EXPECT_FALSE(imu_sample(imu(0.0, 0.0, absurd))) << absurd;
  }
}

// As a damaged log has them: MRPT copies the bytes.
TEST(ImuSample, TakesADamagedFlagForNotSet) {
  CObservationIMU observation = imu(0.0, 0.0, 9.8);
  std::memset(&observation.dataIsPresent[mrpt::obs::IMU_Y_ACC], 2, 1);
  EXPECT_FALSE(imu_sample(observation));
}

TEST(GpsReading, HasTheSpeedOfAValidRmcMessage) {
  auto gps = test::rmc(0.0, 10.0, 90.0);
  EXPECT_NEAR(gps_reading(*gps)->speed.value(), 5.144, 1e-3);
  gps->getMsgByClass<mrpt::obs::gnss::Message_NMEA_RMC>().fields.validity_char = 'V';
  EXPECT_FALSE(gps_reading(*gps));
  EXPECT_FALSE(gps_reading(*test::rmc(0.0, -5.0, 1e9)));
  EXPECT_FALSE(gps_reading(*test::rmc(0.0, std::nan(""), std::nan(""))));
  EXPECT_FALSE(gps_reading(imu(0.0, 0.0, 9.8)));
}

TEST(GpsEpochs, JoinPositionAndSpeedOfOneSecond) {
  GpsEpochs epochs;
  const auto place = [&](const mrpt::obs::CObservationGPS::Ptr& gps) {
    return epochs.add(gps_reading(*gps).value());
  };
  const GpsEpochs::Place position = place(test::gga(0.0, 36.7, -4.4, 30.0));
  EXPECT_TRUE(position.begins);
  const GpsEpochs::Place speed = place(test::rmc(0.2, 10.0, 90.0));
  EXPECT_FALSE(speed.begins);
  EXPECT_EQ(speed.time_s, position.time_s);
  EXPECT_TRUE(place(test::rmc(0.4, 10.0, 90.0)).begins);
}

/// 12 m a second to the north-east, at 36.7° north: 110.97 m and 89.37 m per 0.001°.
mrpt::obs::CObservationGPS::Ptr moving_gga(double seconds) {
  const double way = 12.0 * seconds * std::sqrt(0.5);
  return test::gga(seconds, 36.7 + 1e-3 * way / 110.97, -4.4 + 1e-3 * way / 89.37, 30.0);
}

std::optional<SpeedReading> told(SpeedOverGround& speeds,
                                 const mrpt::obs::CObservationGPS::Ptr& gps) {
  return speeds.add(gps_reading(*gps).value());
}

TEST(SpeedOverGround, ComesFromPositionsWhereNoneIsStated) {
  SpeedOverGround speeds;
  EXPECT_FALSE(told(speeds, moving_gga(0.0)));
  for (int second = 1; second < 5; ++second) {
    const auto speed = told(speeds, moving_gga(second));
    ASSERT_TRUE(speed);
    EXPECT_NEAR(speed->speed, 12.0, 0.02);
    EXPECT_NEAR(speed->time_s, test::kStart + second - 0.5, 1e-6);
    EXPECT_GT(speed->sigma, SpeedReading::kDoppler);
  }
}

TEST(SpeedOverGround, IsTheStatedOneWhereThereIsOne) {
  for (const double rmc_at : {-0.1, 0.1}) {  // before the position, or behind it
    SpeedOverGround speeds;
    for (int second = 0; second < 4; ++second) {
      const auto position = moving_gga(second), stated = test::rmc(second + rmc_at, 20.0, 45.0);
      std::vector<SpeedReading> both;
      for (const auto& gps :
           rmc_at < 0.0 ? std::vector{stated, position} : std::vector{position, stated}) {
        if (const auto speed = told(speeds, gps)) both.push_back(*speed);
      }
      ASSERT_EQ(both.size(), 1U);
      EXPECT_NEAR(both[0].speed, 10.289, 1e-3);
      EXPECT_EQ(both[0].sigma, SpeedReading::kDoppler);
    }
  }
}

TEST(SpeedOverGround, TakesPositionsOfAFastReceiverASecondApart) {
  SpeedOverGround speeds;
  std::size_t count = 0;
  for (int tenth = 0; tenth <= 40; ++tenth) {
    const auto speed = told(speeds, moving_gga(0.1 * tenth));
    if (!speed) continue;
    ++count;
    EXPECT_NEAR(speed->speed, 12.0, 0.02);
  }
  EXPECT_GE(count, 4U);
  EXPECT_LE(count, 5U);
}

TEST(SpeedOverGround, LeavesOutAPlaceThatNoCarGetsTo) {
  for (const double off_deg : {0.0005, 0.005, -0.005, 1.0}) {  // 55 m, 550 m, 110 km
    SpeedOverGround speeds;
    for (int second = 0; second < 8; ++second) {
      const auto gps =
          second != 4 ? moving_gga(second) : test::gga(4.0, 36.7 + off_deg, -4.4, 30.0);
      const auto speed = told(speeds, gps);
      if (!speed) continue;
      EXPECT_NEAR(speed->speed, 12.0, 0.05) << off_deg << " at " << second;
    }
  }
}

TEST(SpeedOverGround, GoesOnWhereTheReceiverStays) {
  SpeedOverGround speeds;
  std::size_t count = 0;
  for (int second = 0; second < 10; ++second) {
    auto reading = gps_reading(*moving_gga(second)).value();
    if (second >= 4) reading.position->latitude_deg += 0.01;  // it was wrong before
    const auto speed = speeds.add(reading);
    if (!speed) continue;
    EXPECT_NEAR(speed->speed, 12.0, 0.05) << second;
    ++count;
  }
  EXPECT_EQ(count, 8U);
}

TEST(SpeedOverGround, GoesOnWithinASecondWhereAFastReceiverStays) {
  SpeedOverGround speeds;
  std::optional<double> again_at;
  for (int tenth = 0; tenth <= 60; ++tenth) {
    auto reading = gps_reading(*moving_gga(0.1 * tenth)).value();
    if (tenth >= 30) reading.position->latitude_deg += 0.01;
    const auto speed = speeds.add(reading);
    if (!speed) continue;
    EXPECT_NEAR(speed->speed, 12.0, 0.05) << tenth;
    if (tenth >= 30 && !again_at) again_at = 0.1 * tenth;
  }
  ASSERT_TRUE(again_at);
  EXPECT_LT(*again_at, 4.8);  // 0.8 s between two positions, twice: the last was up to 0.8 s old
}

TEST(SpeedOverGround, SaysNothingAcrossAGap) {
  SpeedOverGround speeds;
  EXPECT_FALSE(told(speeds, moving_gga(0.0)));
  EXPECT_FALSE(told(speeds, moving_gga(3.0)));
  EXPECT_TRUE(told(speeds, moving_gga(4.0)));
}

}  // namespace
}  // namespace oneac
