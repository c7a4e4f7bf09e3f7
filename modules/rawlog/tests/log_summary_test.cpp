#include "oneac/rawlog/log_summary.h"

#include "log_maker.h"

#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationComment.h>

#include <opencv2/imgcodecs.hpp>

namespace oneac {
namespace {

using test::Packing;

const std::filesystem::path kForeignLogs = "/usr/share/mrpt/datasets";  // package mrpt-common

SummaryOptions options_for(const std::filesystem::path& log) {
  return {log, {}, "", "auto"};
}

class Summary : public ::testing::Test {
 protected:
  // 41 raw pairs at 20 Hz, two of the right images there, GPS in bursts of two per second.
  test::Objects drive() {
    test::Objects objects{mrpt::obs::CObservationComment::Create()};
    for (int i = 0; i <= 40; ++i) {
      auto pair = test::external_pair("CAM", 0.05 * i, "p" + std::to_string(i));
      pair->cameraPose =
          mrpt::poses::CPose3DQuat(mrpt::poses::CPose3D(0.785, 0, 0.273, 0, -8.2 * M_PI / 180, 0));
      pair->leftCamera.setDistortionPlumbBob(-0.3, 0.1, 0, 0);
      pair->rightCamera.setDistortionPlumbBob(-0.3, 0.1, 0, 0);
      objects.push_back(pair);
    }
    for (int i = 0; i < 20; ++i) {
      objects.push_back(test::gga(i, 36.7, -4.4, 70));
      objects.push_back(test::rmc(i + 0.03, 10, 90));
    }
    cv::imwrite((folder_.path() / "p3_right.png").string(), test::ramp(0));
    cv::imwrite((folder_.path() / "p4_right.png").string(), test::ramp(0));
    return objects;
  }
  TemporaryFolder folder_;
  std::filesystem::path log_ = folder_.path() / "drive.rawlog";
};

TEST_F(Summary, CountsSensorsRatesAndImages) {
  test::write_log(log_, drive(), Packing::gzip);
  const auto summary = summarise_log(options_for(log_));
  EXPECT_EQ(summary.compression, "gzip");
  EXPECT_EQ(summary.format, "observations");
  EXPECT_EQ(summary.observations, 82U);
  ASSERT_EQ(summary.sensors.size(), 3U);  // by label: the comment has none
  EXPECT_EQ(summary.sensors[1].class_name, "CObservationStereoImages");
  EXPECT_EQ(summary.sensors[1].count, 41U);
  EXPECT_NEAR(summary.sensors[1].rate_hz.value(), 20.0, 1e-3);
  EXPECT_NEAR(summary.sensors[2].rate_hz.value(), 2.0, 1e-3) << "bursts of two are 2 Hz";
  EXPECT_NEAR(*summary.last_s - *summary.first_s, 19.03, 1e-5) << "the comment has no say";
  ASSERT_EQ(summary.cameras.size(), 2U);
  EXPECT_EQ(summary.cameras[0].present, 0U);
  EXPECT_EQ(summary.cameras[1].name, "CAM/right");
  EXPECT_EQ(summary.cameras[1].present, 2U);
  EXPECT_EQ(summary.cameras[1].images, 41U);
  EXPECT_EQ(summary.gps_observations, 40U);
  EXPECT_EQ(summary.gps_epochs_with_position, 20U);
  EXPECT_EQ(summary.gps_epochs_with_speed, 20U);
  EXPECT_FALSE(summary.damage);
}

TEST_F(Summary, TextNamesWhatMatters) {
  test::write_log(log_, drive());
  const std::string text = to_text(summarise_log(options_for(log_)));
  for (const std::string part :
       {"CObservationStereoImages", "41", "20.00 Hz", "2 of 82 present", "CAM/right: 2 of 41",
        "raw, 64x48", "tilt 8.2° upward", "x_forward", "(0.785, -0.120, 0.273)", "duration: 19.0 s",
        "GPS: 40 observations"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in:\n" << text;
  }
}

TEST_F(Summary, ShowsAGivenCalibration) {
  test::write_log(log_, drive());
  test::write_bytes(folder_.path() / "calib.txt", "P0: 60 0 31 0 0 61 23 0 0 0 1 0\n");
  auto options = options_for(log_);
  options.calibration = (folder_.path() / "calib.txt").string();
  const std::string text = to_text(summarise_log(options));
  EXPECT_NE(text.find("rectified, f (60, 61) px"), std::string::npos) << text;
  EXPECT_NE(text.find("given by --calibration"), std::string::npos);
}

TEST_F(Summary, KeepsWhatWasReadOfADamagedLog) {
  std::string bytes = test::packed(drive(), Packing::gzip);
  bytes.resize(bytes.size() - bytes.size() / 4);
  test::write_bytes(log_, bytes);
  const auto summary = summarise_log(options_for(log_));
  EXPECT_GT(summary.observations, 10U);
  ASSERT_TRUE(summary.damage);
  EXPECT_NE(std::string(summary.damage->what()).find("ends early"), std::string::npos);
}

TEST_F(Summary, SaysThatALogHasNoImages) {
  test::write_log(log_, {test::rmc(0, 1, 1)});
  EXPECT_NE(to_text(summarise_log(options_for(log_))).find("images: none"), std::string::npos);
}

class ForeignLog : public ::testing::TestWithParam<const char*> {};

TEST_P(ForeignLog, IsReadToItsEnd) {
  const auto log = kForeignLogs / GetParam();
  ASSERT_TRUE(std::filesystem::exists(log)) << log << ": install the package mrpt-common";
  const auto summary = summarise_log(options_for(log));
  EXPECT_FALSE(summary.damage) << summary.damage->what();
  EXPECT_GT(summary.observations, 0U);
  EXPECT_TRUE(summary.cameras.empty());
  EXPECT_FALSE(to_text(summary).empty());
}

INSTANTIATE_TEST_SUITE_P(MrptCommon, ForeignLog,
                         ::testing::Values("tests_rgbd.rawlog", "test_rtk_path.rawlog",
                                           "kf-slam_demo.rawlog", "localization_demo.rawlog"));

TEST(ForeignLog, OfAClassThisBuildDoesNotKnowIsRefusedWithACure) {
  const auto log = kForeignLogs / "rot_scan_2d.rawlog";
  ASSERT_TRUE(std::filesystem::exists(log)) << log << ": install the package mrpt-common";
  const auto fault = test::input_error([&] { static_cast<void>(summarise_log(options_for(log))); });
  EXPECT_NE(fault.find("CObservationRotatingScan"), std::string::npos) << fault;
  EXPECT_NE(fault.find("rawlog-edit"), std::string::npos) << fault;
}

}  // namespace
}  // namespace oneac
