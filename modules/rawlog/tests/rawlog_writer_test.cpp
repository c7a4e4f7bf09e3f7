#include "oneac/rawlog/rawlog_writer.h"

#include "writing_support.h"

#include "oneac/geometry/camera_frame.h"
#include "oneac/geometry/levelling.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <mrpt/topography/conversions.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

namespace oneac {
namespace {

using namespace mrpt::obs;
using test::copied;
using test::only;
using test::read_with_mrpt;

constexpr double kTime = 1261229981.580023;
constexpr double kDegree = M_PI / 180.0;

PinholeCamera camera() {
  return {640, 480, 500.0, 510.0, 320.5, 241.0, {}};
}

Eigen::Isometry3d tilted_mount() {
  Eigen::Isometry3d T = CameraFrame::forward_looking_mount();
  T.linear() = T.linear() * levelling_rotation({8.2 * kDegree, 0.0});
  T.translation() << 0.785, 0.1, 1.5;
  return T;
}

ImageRecord image_record(MountConvention convention) {
  return {kTime, "CAMERA1", camera(), tilted_mount(), convention, "a.jpg"};
}

class RawlogWriterTest : public ::testing::Test {
 protected:
  template <class... Records>
  std::vector<CObservation::Ptr> written(const Records&... records) const {
    RawlogWriter writer(log_);
    (writer.write(records), ...);
    writer.close();
    return read_with_mrpt(log_);
  }

  TemporaryFolder folder_;
  std::filesystem::path log_ = folder_.path() / "drive.rawlog";
};

TEST_F(RawlogWriterTest, StoresTimeLabelCalibrationAndFileOfAnImage) {
  const auto images = only<CObservationImage>(written(image_record(MountConvention::optical)));
  ASSERT_EQ(images.size(), 1U);
  EXPECT_NEAR(mrpt::Clock::toDouble(images[0]->timestamp), kTime, 5e-7);
  EXPECT_EQ(images[0]->sensorLabel, "CAMERA1");
  EXPECT_EQ(images[0]->image.getExternalStorageFile(), "a.jpg");
  EXPECT_EQ(images[0]->cameraParams.ncols, 640U);
  EXPECT_EQ(images[0]->cameraParams.nrows, 480U);
  EXPECT_EQ(images[0]->cameraParams.fx(), 500.0);
  EXPECT_EQ(images[0]->cameraParams.fy(), 510.0);
  EXPECT_EQ(images[0]->cameraParams.cx(), 320.5);
  EXPECT_EQ(images[0]->cameraParams.cy(), 241.0);
}

TEST_F(RawlogWriterTest, KeepsDistortion) {
  ImageRecord record = image_record(MountConvention::optical);
  record.camera.distortion = {-0.36, 0.17, 0.001, -0.002, 0.01};
  const auto images = only<CObservationImage>(written(record));
  ASSERT_EQ(images.size(), 1U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(images[0]->cameraParams.dist[i], record.camera.distortion[i]) << i;
  }
}

TEST_F(RawlogWriterTest, AnXForwardPoseIsThatOfMalaga) {
  const auto images = only<CObservationImage>(written(image_record(MountConvention::x_forward)));
  ASSERT_EQ(images.size(), 1U);
  const mrpt::poses::CPose3D& pose = images[0]->cameraPose;
  EXPECT_NEAR(pose.x(), 0.785, 1e-12);
  EXPECT_NEAR(pose.z(), 1.5, 1e-12);
  EXPECT_NEAR(pose.yaw(), 0.0, 1e-9);
  EXPECT_NEAR(pose.pitch(), -8.2 * kDegree, 1e-9);  // positive pitch looks down
  EXPECT_NEAR(pose.roll(), 0.0, 1e-9);
}

TEST_F(RawlogWriterTest, AnOpticalPoseIsTheCameraItself) {
  ImageRecord record = image_record(MountConvention::optical);
  record.T_vehicle_cam = CameraFrame::forward_looking_mount();
  const auto images = only<CObservationImage>(written(record));
  ASSERT_EQ(images.size(), 1U);
  EXPECT_NEAR(images[0]->cameraPose.yaw(), -90.0 * kDegree, 1e-9);
  EXPECT_NEAR(images[0]->cameraPose.pitch(), 0.0, 1e-9);
  EXPECT_NEAR(images[0]->cameraPose.roll(), -90.0 * kDegree, 1e-9);
}

TEST_F(RawlogWriterTest, StoresBothSidesOfAPair) {
  StereoRecord record;
  record.time_s = kTime;
  record.label = "CAMERA1";
  record.left = record.right = camera();
  record.T_vehicle_left = tilted_mount();
  record.T_left_right.translation().x() = 0.12;
  record.convention = MountConvention::x_forward;
  record.left_file = "l.jpg";
  record.right_file = "r.jpg";
  const auto pairs = only<CObservationStereoImages>(written(record));
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0]->imageLeft.getExternalStorageFile(), "l.jpg");
  EXPECT_TRUE(pairs[0]->hasImageRight);
  EXPECT_EQ(pairs[0]->imageRight.getExternalStorageFile(), "r.jpg");
  EXPECT_NEAR(pairs[0]->rightCameraPose.x(), 0.12, 1e-12);
  EXPECT_NEAR(mrpt::poses::CPose3D(pairs[0]->cameraPose).pitch(), -8.2 * kDegree, 1e-9);
  EXPECT_TRUE(pairs[0]->areImagesRectified());
}

TEST_F(RawlogWriterTest, WritesGpsAsTwoObservationsUnderOneLabel) {
  GpsRecord record;
  record.time_s = kTime;
  record.label = "GPS";
  record.position = {36.7242, -4.4762, 77.9};
  record.satellites = 9;
  record.velocity = GroundVelocity{10.0, 145.2};
  const auto gps = only<CObservationGPS>(written(record));
  ASSERT_EQ(gps.size(), 2U);
  EXPECT_EQ(gps[0]->sensorLabel, "GPS");
  EXPECT_EQ(gps[1]->sensorLabel, "GPS");
  EXPECT_EQ(gps[0]->timestamp, gps[1]->timestamp);
  const auto& gga = gps[0]->getMsgByClass<gnss::Message_NMEA_GGA>().fields;
  EXPECT_EQ(copied(gga.latitude_degrees), 36.7242);
  EXPECT_EQ(copied(gga.longitude_degrees), -4.4762);
  EXPECT_EQ(copied(gga.altitude_meters), 77.9);
  EXPECT_EQ(copied(gga.satellitesUsed), 9U);
  const auto& rmc = gps[1]->getMsgByClass<gnss::Message_NMEA_RMC>().fields;
  EXPECT_NEAR(rmc.speed_knots, 19.4384, 1e-4);
  EXPECT_EQ(copied(rmc.direction_degrees), 145.2);
  EXPECT_EQ(copied(rmc.validity_char), 'A');
}

TEST_F(RawlogWriterTest, GpsCarriesTheUtcTimeAndDateOfItsStamp) {
  GpsRecord record;
  record.time_s = kTime;  // 19 December 2009, 13:39:41.580023 UTC
  record.velocity = GroundVelocity{};
  const auto gps = only<CObservationGPS>(written(record));
  ASSERT_EQ(gps.size(), 2U);
  const auto& rmc = gps[1]->getMsgByClass<gnss::Message_NMEA_RMC>().fields;
  EXPECT_EQ(copied(rmc.UTCTime.hour), 13);
  EXPECT_EQ(copied(rmc.UTCTime.minute), 39);
  EXPECT_NEAR(rmc.UTCTime.sec, 41.580023, 1e-6);
  EXPECT_EQ(copied(rmc.date_day), 19);
  EXPECT_EQ(copied(rmc.date_month), 12);
  EXPECT_EQ(copied(rmc.date_year), 9);
}

TEST_F(RawlogWriterTest, WithoutVelocityThereIsNoRmc) {
  EXPECT_EQ(only<CObservationGPS>(written(GpsRecord{})).size(), 1U);
}

TEST_F(RawlogWriterTest, StoresInertialReadings) {
  const ImuRecord record{kTime, "IMU", {0.1, 0.2, 9.8}, {0.01, 0.02, 0.03}};
  const auto imu = only<CObservationIMU>(written(record));
  ASSERT_EQ(imu.size(), 1U);
  EXPECT_EQ(imu[0]->get(IMU_Z_ACC), 9.8);
  EXPECT_EQ(imu[0]->get(IMU_ROLL_VEL), 0.01);
  EXPECT_EQ(imu[0]->get(IMU_PITCH_VEL), 0.02);
  EXPECT_EQ(imu[0]->get(IMU_YAW_VEL), 0.03);
}

TEST_F(RawlogWriterTest, AppearsWholeOrNotAtAll) {
  {
    RawlogWriter writer(log_);
    writer.write(image_record(MountConvention::optical));
    EXPECT_FALSE(std::filesystem::exists(log_));
  }
  EXPECT_TRUE(test::names_in(folder_.path()).empty());
}

TEST_F(RawlogWriterTest, ReplacesARawlogAndNothingElse) {
  written(image_record(MountConvention::optical));
  EXPECT_EQ(written(image_record(MountConvention::optical)).size(), 1U);
  const std::string video = "ftypisom, and hours that nobody films again";
  std::ofstream(log_) << video;
  const auto said = test::complaint_of([this] { RawlogWriter writer(log_); });
  EXPECT_NE(said.find("drive.rawlog: is there and is no rawlog"), std::string::npos) << said;
  std::ifstream kept(log_);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(kept), {}), video);
  std::ofstream(log_, std::ios::trunc).close();
  EXPECT_EQ(written(image_record(MountConvention::optical)).size(),
            1U);  // an empty one holds nothing
}

TEST_F(RawlogWriterTest, NamesAFolderThatCannotBeWrittenTo) {
  const std::string text = test::complaint_of([] { RawlogWriter("/proc/nowhere/a.rawlog"); });
  EXPECT_NE(text.find("/proc/nowhere"), std::string::npos) << text;
  EXPECT_NE(test::complaint_of([&] { RawlogWriter writer(folder_.path()); }), "");
}

TEST(GeodeticFromEnu, IsTheInverseOfMrptsConversion) {
  const GeodeticPosition origin{36.7242, -4.4762, 70.0};
  const Eigen::Vector3d enu(120.0, -45.0, 3.0);
  const GeodeticPosition position = geodetic_from_enu(enu, origin);
  mrpt::math::TPoint3D back;
  mrpt::topography::geodeticToENU_WGS84(
      {position.latitude_deg, position.longitude_deg, position.altitude_m}, back,
      {origin.latitude_deg, origin.longitude_deg, origin.altitude_m});
  EXPECT_LT((Eigen::Vector3d(back.x, back.y, back.z) - enu).norm(), 1e-4);
}

}  // namespace
}  // namespace oneac
