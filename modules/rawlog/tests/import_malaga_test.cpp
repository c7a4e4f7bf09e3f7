#include "oneac/rawlog/import_malaga.h"

#include "writing_support.h"

#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <cmath>

namespace oneac {
namespace {

namespace fs = std::filesystem;
using mrpt::obs::CObservationGPS;
using mrpt::obs::CObservationIMU;
using mrpt::obs::CObservationStereoImages;
using mrpt::obs::gnss::Message_NMEA_GGA;
using mrpt::obs::gnss::Message_NMEA_RMC;
using test::write_text;

constexpr double kDegree = M_PI / 180.0;

std::string calibration(int width, int height, double fx, const std::string& prefix = "CAMERA") {
  const std::string size = std::to_string(width) + " " + std::to_string(height);
  const auto side = [&](const std::string& name) {
    return "[" + prefix + "_" + name + "]\nresolution=[" + size +
           "]\ncx=30\ncy=20\nfx=" + std::to_string(fx) + "\nfy=" + std::to_string(fx) +
           "\ndist=[0.0e+000 0.0e+000 0.0e+000 0.0e+000 0.0e+000]\n";
  };
  return "# made for a test\n" + side("LEFT") + side("RIGHT") + "[" + prefix +
         "_LEFT2RIGHT_POSE]\npose_quaternion=[0.119471 0.0 0.0 1.0 0.0 0.0 0.0]\n";
}

std::string gps_text(const std::string& speed_and_course) {
  return "%  Time  Lat  Lon  Alt  fix #sats  speed  dir  Local X\n"
         "1261229982.0000 0.64095893 -0.07812454 77.9 1 9 " +
         speed_and_course +
         " 0.0\n"
         "1261229983.0000 0.64095846 -0.07812364 75.6 1 8 " +
         speed_and_course + " 4.6\n";
}

class ImportMalaga : public ::testing::Test {
 protected:
  ImportMalaga() {
    options_.source = folder_.path() / "extract";
    options_.log = folder_.path() / "m.rawlog";
    fs::create_directories(options_.source);
  }
  void make_extract(const std::string& images = "Images") {
    for (const char* name :
         {"img_CAMERA1_1261229981.580023_left.jpg", "img_CAMERA1_1261229981.580023_right.jpg",
          "img_CAMERA1_1261229982.630020_right.jpg", "img_CAMERA1_1261229983.680019_left.jpg"}) {
      test::write_image(options_.source / images / name);
    }
    write_text(options_.source / "camera_params_raw_64x48.txt",
               calibration(64, 48, 66, "CAMERA_PARAMS"));
    write_text(options_.source / "camera_params_rectified_a=0_64x48.txt", calibration(64, 48, 50));
    write_text(options_.source / "camera_params_rectified_a=0_32x24.txt", calibration(32, 24, 25));
    write_text(options_.source / "x_GPS.txt", gps_text("0.0 0.0"));
    write_text(options_.source / "x_IMU.txt",
               "% Time IMU_X_ACC IMU_Y_ACC IMU_Z_ACC IMU_YAW_VEL IMU_PITCH_VEL IMU_ROLL_VEL\n"
               "1261229981.5854 0.04 2.09 9.61 0.35 0.007 -0.02 0 0 0\n");
  }
  [[nodiscard]] std::vector<mrpt::obs::CObservation::Ptr> log() const {
    return test::read_with_mrpt(options_.log);
  }
  [[nodiscard]] std::vector<CObservationStereoImages::Ptr> pairs() const {
    return test::only<CObservationStereoImages>(log());
  }
  [[nodiscard]] std::string complaint() const {
    return test::complaint_of([this] { import_malaga(options_); });
  }

  TemporaryFolder folder_;
  MalagaImport options_;
};

TEST_F(ImportMalaga, RawlogEditReadsTheLog) {
  make_extract();
  const ImportReport report = import_malaga(options_);
  EXPECT_EQ(report.observations, 3U);
  EXPECT_EQ(report.images, 4U);
  EXPECT_EQ(report.gps, 2U);
  EXPECT_EQ(report.imu, 1U);
  const std::string info = test::rawlog_edit_info(options_.log);
  EXPECT_NE(info.find("Overall number of objects         : 6"), std::string::npos) << info;
  EXPECT_NE(info.find("CAMERA1, GPS_DELUO, XSensMTi"), std::string::npos) << info;
}

TEST_F(ImportMalaga, PairsImagesByTimeAndToleratesAMissingSide) {
  make_extract();
  import_malaga(options_);
  const auto stored = pairs();
  ASSERT_EQ(stored.size(), 3U);
  EXPECT_NEAR(mrpt::Clock::toDouble(stored[0]->timestamp), 1261229981.580023, 5e-7);
  EXPECT_TRUE(stored[0]->hasImageRight);
  EXPECT_TRUE(stored[1]->hasImageRight);
  EXPECT_EQ(stored[1]->imageLeft.getExternalStorageFile(),
            "img_CAMERA1_1261229982.630020_left.jpg");
  EXPECT_FALSE(stored[2]->hasImageRight);
  EXPECT_TRUE(fs::exists(stored[2]->imageLeft.getExternalStorageFile()));
}

TEST_F(ImportMalaga, MountsTheCameraAsTheDatasetsLogsDo) {
  make_extract();
  import_malaga(options_);
  const mrpt::poses::CPose3D pose(pairs().at(0)->cameraPose);
  EXPECT_NEAR(pose.x(), 0.785, 1e-9);
  EXPECT_NEAR(pose.z(), 0.273, 1e-9);
  EXPECT_NEAR(pose.yaw(), 0.0, 1e-9);
  EXPECT_NEAR(pose.pitch(), -8.2 * kDegree, 1e-9);
  EXPECT_NEAR(pose.roll(), 0.0, 1e-9);
  EXPECT_NEAR(pairs().at(0)->rightCameraPose.x(), 0.119471, 1e-9);
}

TEST_F(ImportMalaga, TakesTheRectifiedCalibrationOfTheImagesSize) {
  make_extract();
  import_malaga(options_);
  EXPECT_EQ(pairs().at(0)->leftCamera.fx(), 50.0);
  EXPECT_EQ(pairs().at(0)->rightCamera.fx(), 50.0);
}

TEST_F(ImportMalaga, FallsBackToTheRawCalibration) {
  make_extract();
  fs::remove(options_.source / "camera_params_rectified_a=0_64x48.txt");
  import_malaga(options_);
  EXPECT_EQ(pairs().at(0)->leftCamera.fx(), 66.0);
}

TEST_F(ImportMalaga, ListsCalibrationsThatDoNotFit) {
  make_extract();
  fs::remove(options_.source / "camera_params_rectified_a=0_64x48.txt");
  fs::remove(options_.source / "camera_params_raw_64x48.txt");
  EXPECT_NE(complaint().find("64x48"), std::string::npos) << complaint();
  EXPECT_NE(complaint().find("camera_params_rectified_a=0_32x24.txt (32x24)"), std::string::npos);
}

TEST_F(ImportMalaga, PositionsAreInDegreesAndZeroVelocitiesAreNone) {
  make_extract();
  import_malaga(options_);
  const auto gps = test::only<CObservationGPS>(log());
  ASSERT_EQ(gps.size(), 2U);
  const auto& gga = gps[0]->getMsgByClass<Message_NMEA_GGA>().fields;
  EXPECT_NEAR(gga.latitude_degrees, 36.7242, 1e-4);
  EXPECT_NEAR(gga.longitude_degrees, -4.4762, 1e-4);
  EXPECT_EQ(test::copied(gga.altitude_meters), 77.9);
  EXPECT_FALSE(gps[0]->hasMsgClass<Message_NMEA_RMC>());
}

TEST_F(ImportMalaga, KeepsSpeedAndCourseWhereTheTextHasThem) {
  make_extract();
  write_text(options_.source / "x_GPS.txt", gps_text("10.64 145.22"));
  import_malaga(options_);
  const auto gps = test::only<CObservationGPS>(log());
  ASSERT_EQ(gps.size(), 4U);
  const auto& rmc = gps[1]->getMsgByClass<Message_NMEA_RMC>().fields;
  EXPECT_NEAR(rmc.speed_knots, 10.64, 1e-9);
  EXPECT_NEAR(rmc.direction_degrees, 145.22, 1e-9);
}

TEST_F(ImportMalaga, RefusesPositionsInDegrees) {
  make_extract();
  write_text(options_.source / "x_GPS.txt", "1261229982.0 36.72 -4.47 77.9 1 9 0 0\n");
  EXPECT_NE(complaint().find("radians"), std::string::npos) << complaint();
}

TEST_F(ImportMalaga, InertialRatesKeepTheirAxes) {
  make_extract();
  import_malaga(options_);
  const auto imu = test::only<CObservationIMU>(log());
  ASSERT_EQ(imu.size(), 1U);
  EXPECT_EQ(imu[0]->get(mrpt::obs::IMU_Z_ACC), 9.61);
  EXPECT_EQ(imu[0]->get(mrpt::obs::IMU_YAW_VEL), 0.35);
  EXPECT_EQ(imu[0]->get(mrpt::obs::IMU_PITCH_VEL), 0.007);
  EXPECT_EQ(imu[0]->get(mrpt::obs::IMU_ROLL_VEL), -0.02);
}

TEST_F(ImportMalaga, RecordsAreInTheOrderOfTime) {
  make_extract();
  import_malaga(options_);
  const auto stored = log();
  for (std::size_t i = 1; i < stored.size(); ++i) {
    EXPECT_LE(stored[i - 1]->timestamp, stored[i]->timestamp) << i;
  }
}

TEST_F(ImportMalaga, FindsImagesInTheOtherPlacesToo) {
  make_extract("malaga_rectified_800x600_Images");
  EXPECT_EQ(import_malaga(options_).images, 4U);
  fs::remove_all(options_.source);
  make_extract(".");
  EXPECT_EQ(import_malaga(options_).images, 4U);
}

TEST_F(ImportMalaga, CopiesImagesOnRequest) {
  make_extract();
  options_.copy_images = true;
  import_malaga(options_);
  EXPECT_EQ(test::names_in(folder_.path() / "m_Images").size(), 4U);
  EXPECT_EQ(pairs().at(0)->imageRight.getExternalStorageFile(),
            "img_CAMERA1_1261229981.580023_right.jpg");
}

TEST_F(ImportMalaga, NotesMissingSensors) {
  make_extract();
  fs::remove(options_.source / "x_GPS.txt");
  fs::remove(options_.source / "x_IMU.txt");
  const ImportReport report = import_malaga(options_);
  EXPECT_EQ(report.gps + report.imu, 0U);
  EXPECT_NE(report.notes.at(0).find("_GPS.txt"), std::string::npos);
  EXPECT_NE(report.notes.at(1).find("_IMU.txt"), std::string::npos);
}

TEST_F(ImportMalaga, SaysWhereItLookedForImages) {
  test::write_image(options_.source / "Images" / "000000.png");
  EXPECT_NE(complaint().find("img_CAMERA1_<time>_left|right.jpg in Images"), std::string::npos);
  options_.source = folder_.path() / "nowhere";
  EXPECT_NE(complaint().find("no such folder"), std::string::npos);
}

}  // namespace
}  // namespace oneac
