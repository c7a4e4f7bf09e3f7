#include "read/reference_collector.h"

#include "log_maker.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationIMU.h>

#include <cstring>
#include <limits>

namespace oneac {
namespace {

using test::gga;
using test::kStart;
using test::rmc;

TEST(ReferenceCollector, MergesTheTwoSentencesOfASecond) {
  ReferenceCollector collector;
  for (int i = 0; i < 3; ++i) {
    collector.add(*gga(i, 36.7, -4.4, 70));
    collector.add(*rmc(i + 0.1, 10, 90));
  }
  const auto gps = collector.build().gps;
  ASSERT_EQ(gps.size(), 3U);
  for (const auto& fix : gps) {
    EXPECT_TRUE(fix.position_enu && fix.speed && fix.course);
  }
  EXPECT_NEAR(gps[1].time_s, kStart + 1, 1e-6);
}

TEST(ReferenceCollector, TellsSpeedsByPositionsOfTheReceiverThatCounts) {
  ReferenceCollector collector;
  for (int i = 3; i >= 0; --i) collector.add(*gga(i, 36.7 + 1e-4 * i, -4.4, 70));  // out of order
  const auto spare = rmc(0, 99, 90);
  spare->sensorLabel = "SPARE";
  collector.add(*spare);
  const auto reference = collector.build();
  ASSERT_EQ(reference.speeds.size(), 3U);
  for (const SpeedReading& speed : reference.speeds) EXPECT_NEAR(speed.speed, 11.097, 0.01);
  EXPECT_NEAR(reference.speeds[0].time_s, kStart + 0.5, 1e-6);
  EXPECT_FALSE(reference.gps[0].speed) << "a fix holds what the log says";
}

TEST(ReferenceCollector, KeepsSentencesFurtherApartThanHalfASecondApart) {
  ReferenceCollector collector;
  collector.add(*gga(0, 36.7, -4.4, 70));
  collector.add(*rmc(0.6, 10, 90));
  EXPECT_EQ(collector.build().gps.size(), 2U);
}

TEST(ReferenceCollector, ConvertsKnotsAndDegrees) {
  ReferenceCollector collector;
  collector.add(*rmc(0, 10, 90));
  const auto gps = collector.build().gps;
  ASSERT_EQ(gps.size(), 1U);
  EXPECT_NEAR(*gps[0].speed, 5.14444, 1e-5);
  EXPECT_NEAR(*gps[0].course, M_PI / 2, 1e-12);
}

TEST(ReferenceCollector, PutsPositionsIntoEastNorthUpOfTheFirstFix) {
  ReferenceCollector collector;
  collector.add(*gga(0, 36.7, -4.4, 70));
  collector.add(*gga(1, 36.701, -4.4, 70));
  collector.add(*gga(2, 36.7, -4.399, 71));
  const auto gps = collector.build().gps;
  ASSERT_EQ(gps.size(), 3U);
  EXPECT_TRUE(gps[0].position_enu->isZero(1e-6));
  // WGS84 at 36.7° north: 110.97 m per 0.001° of latitude, 89.37 m of longitude
  EXPECT_NEAR(gps[1].position_enu->y(), 110.97, 0.05);
  EXPECT_NEAR(gps[1].position_enu->x(), 0.0, 0.01);
  EXPECT_NEAR(gps[2].position_enu->x(), 89.37, 0.05);
  EXPECT_NEAR(gps[2].position_enu->z(), 1.0, 0.01);
}

TEST(ReferenceCollector, DropsVoidAndBrokenFixes) {
  ReferenceCollector collector;
  auto no_fix = gga(0, 36.7, -4.4, 70);
  no_fix->getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>().fields.fix_quality = 0;
  auto void_rmc = rmc(1, 10, 90);
  void_rmc->getMsgByClass<mrpt::obs::gnss::Message_NMEA_RMC>().fields.validity_char = 'V';
  collector.add(*no_fix);
  collector.add(*void_rmc);
  collector.add(*gga(2, std::numeric_limits<double>::quiet_NaN(), -4.4, 70));
  collector.add(*rmc(3, std::numeric_limits<double>::infinity(), 20));
  auto unstamped = rmc(4, 10, 90);
  unstamped->timestamp = INVALID_TIMESTAMP;
  collector.add(*unstamped);
  const auto gps = collector.build().gps;
  ASSERT_EQ(gps.size(), 1U);
  EXPECT_FALSE(gps[0].speed);
  EXPECT_TRUE(gps[0].course);
}

TEST(ReferenceCollector, PutsEpochsIntoTimeOrderAndKeepsReceiversApart) {
  ReferenceCollector collector;
  collector.add(*rmc(2, 10, 20));
  collector.add(*rmc(1, 10, 10));
  auto other = rmc(1.5, 99, 300);
  other->sensorLabel = "ANOTHER";
  collector.add(*other);
  const auto gps = collector.build().gps;
  ASSERT_EQ(gps.size(), 2U);
  EXPECT_LT(gps[0].time_s, gps[1].time_s);
  EXPECT_LT(*gps[0].speed, 10.0);
}

TEST(ReferenceCollector, ReadsWhatAnImuHas) {
  ReferenceCollector collector;
  mrpt::obs::CObservationIMU imu;
  imu.timestamp = mrpt::Clock::fromDouble(kStart);
  imu.set(mrpt::obs::IMU_WX, 0.1);
  imu.set(mrpt::obs::IMU_WY, 0.2);
  imu.set(mrpt::obs::IMU_WZ, 0.3);
  imu.set(mrpt::obs::IMU_X_ACC, 1.0);
  collector.add(imu);
  const auto samples = collector.build().imu;
  ASSERT_EQ(samples.size(), 1U);
  ASSERT_TRUE(samples[0].angular_rate);
  EXPECT_TRUE(samples[0].angular_rate->isApprox(Eigen::Vector3d(0.1, 0.2, 0.3)));
  EXPECT_FALSE(samples[0].acceleration) << "two of its axes are not in the log";
}

// As a damaged log has it: MRPT copies the byte.
TEST(ReferenceCollector, LeavesOutWhatADamagedFlagSaysOfAnImu) {
  ReferenceCollector collector;
  mrpt::obs::CObservationIMU imu;
  imu.timestamp = mrpt::Clock::fromDouble(kStart);
  for (const auto field : {mrpt::obs::IMU_WX, mrpt::obs::IMU_WY, mrpt::obs::IMU_WZ}) {
    imu.set(field, 0.1);
  }
  std::memset(&imu.dataIsPresent[mrpt::obs::IMU_WY], 2, 1);
  collector.add(imu);
  EXPECT_TRUE(collector.build().imu.empty());
}

TEST(ReferenceCollector, TurnsAnImuIntoTheVehiclesAxes) {
  ReferenceCollector collector;
  mrpt::obs::CObservationIMU imu;
  imu.timestamp = mrpt::Clock::fromDouble(kStart);
  imu.sensorPose = mrpt::poses::CPose3D(1.0, 2.0, 3.0, M_PI / 2, 0.0, 0.0);  // its X is the left
  imu.set(mrpt::obs::IMU_X_ACC, 2.0);
  imu.set(mrpt::obs::IMU_Y_ACC, 0.5);
  imu.set(mrpt::obs::IMU_Z_ACC, 9.8);
  collector.add(imu);
  const auto samples = collector.build().imu;
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_TRUE(samples[0].acceleration->isApprox(Eigen::Vector3d(-0.5, 2.0, 9.8)));
}

}  // namespace
}  // namespace oneac
