#include "read/log_layout.h"

#include "log_maker.h"

#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>

namespace oneac {
namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class LogLayout : public ::testing::Test {
 protected:
  /// A log beside `folder_`'s files with two images of four and a calibration.
  LogSummary summary(const std::string& name) const {
    LogSummary summary;
    summary.log = folder_.path() / name;
    CameraSummary camera;
    camera.images = 4;
    camera.present = 2;
    camera.calibration = PinholeCamera{};
    summary.cameras.push_back(camera);
    return summary;
  }
  TemporaryFolder folder_;
};

TEST_F(LogLayout, SaysWhereMissingImagesBelong) {
  const std::string text = missing_lines(summary("drive.rawlog"));
  EXPECT_TRUE(has(text, "2 of 4 images")) << text;
  EXPECT_TRUE(has(text, (folder_.path() / "Images").string())) << text;
  EXPECT_TRUE(has(text, "--images-dir")) << text;
  EXPECT_FALSE(has(text, "fetch.sh")) << "no public drive:\n" << text;
}

TEST_F(LogLayout, NamesTheFolderThatHoldsSomeOfThem) {
  LogSummary partial = summary("drive.rawlog");
  partial.image_folders = {"/somewhere/drive_Images"};
  EXPECT_TRUE(has(missing_lines(partial), "put them into /somewhere/drive_Images"));
}

TEST_F(LogLayout, KnowsTheExtractsOfMalaga) {
  const std::string text = missing_lines(summary("malaga-urban-dataset-extract-07_CAM_GPS.rawlog"));
  EXPECT_TRUE(has(text, "camera_params_*.txt"));
  EXPECT_TRUE(has(text, "fetch.sh malaga-07"));
  EXPECT_TRUE(has(text, "https://www.mrpt.org/MalagaUrbanDataset"));
}

TEST_F(LogLayout, SeesCameraParametersBesideTheLog) {
  test::write_bytes(folder_.path() / "camera_params_raw_1024x768.txt", "x");
  const std::string text = missing_lines(summary("malaga-urban-dataset-extract-07_CAM_GPS.rawlog"));
  EXPECT_FALSE(has(text, "camera_params_")) << text;
}

TEST_F(LogLayout, AsksForACalibrationWhereTheLogHasNone) {
  LogSummary uncalibrated = summary("drive.rawlog");
  uncalibrated.cameras[0].calibration.reset();
  EXPECT_TRUE(has(missing_lines(uncalibrated), "--calibration FILE"));
}

TEST_F(LogLayout, IsSilentWhenNothingIsMissing) {
  LogSummary whole = summary("drive.rawlog");
  whole.cameras[0].present = 4;
  EXPECT_EQ(missing_lines(whole), "");
  whole.cameras.clear();
  EXPECT_EQ(missing_lines(whole), "") << "a log without cameras misses none";
}

TEST_F(LogLayout, EndsTheTextOfTheSummary) {
  EXPECT_TRUE(has(to_text(summary("drive.rawlog")), "missing\n  2 of 4 images"));
}

}  // namespace
}  // namespace oneac
