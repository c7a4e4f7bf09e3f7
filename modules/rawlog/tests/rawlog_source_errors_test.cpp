#include "log_maker.h"

#include "oneac/rawlog/rawlog_source.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>

namespace oneac {
namespace {

using test::Packing;
using test::ramp;

class SourceErrors : public ::testing::Test {
 protected:
  // Opens the log, loads everything; the InputError on the way, "" without one.
  std::string fault() {
    return test::input_error([&] {
      RawlogSource source(options_);
      while (auto ticket = source.next()) static_cast<void>(source.load(*ticket));
    });
  }
  void expect_fault(const std::vector<std::string>& parts) {
    const std::string message = fault();
    for (const auto& part : parts) {
      EXPECT_NE(message.find(part), std::string::npos) << part << " is not in: " << message;
    }
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
  TemporaryFolder folder_;
  SourceOptions options_{folder_.path() / "drive.rawlog", {}, "", "", "auto", {}, 0, 0, 1};
};

TEST_F(SourceErrors, NoSuchFile) {
  expect_fault({"drive.rawlog", "no such file"});
}

TEST_F(SourceErrors, LogWithoutImages) {
  test::write_log(options_.log, {test::rmc(0, 1, 1)});
  expect_fault({"drive.rawlog", "no camera images", "GPS (CObservationGPS)"});
}

TEST_F(SourceErrors, WrongLabelListsThoseThatExist) {
  test::write_log(options_.log,
                  {test::stored_image("FRONT", 0, ramp(0)), test::external_pair("PAIR", 0, "p")});
  options_.camera = "REAR";
  expect_fault({"no camera 'REAR'", "'FRONT'", "'PAIR/left'", "'PAIR/right'"});
}

TEST_F(SourceErrors, SeveralCamerasNeedAChoice) {
  test::write_log(options_.log,
                  {test::stored_image("A", 0, ramp(0)), test::stored_image("B", 0, ramp(0))});
  expect_fault({"several cameras", "--camera", "'A', 'B'"});
}

TEST_F(SourceErrors, SideIsAmbiguousWithTwoPairs) {
  test::write_log(options_.log,
                  {test::external_pair("A", 0, "a"), test::external_pair("B", 0, "b")});
  options_.camera = "left";
  expect_fault({"several cameras", "'A/left'", "'B/left'"});
}

TEST_F(SourceErrors, ImagesDirWithNothingInItIsNotReplacedByAnother) {
  test::write_log(options_.log, {test::external_image("CAM", 0, "a.png")});
  cv::imwrite((folder_.path() / "a.png").string(), ramp(0));
  EXPECT_EQ(fault(), "");
  options_.images_dir = folder_.path() / "empty";
  expect_fault({"empty", "no such folder", "--images-dir"});
  std::filesystem::create_directory(options_.images_dir);
  expect_fault({"none of the 1 images", "CAM", options_.images_dir.string(), "--images-dir"});
}

TEST_F(SourceErrors, NoImageAnywhereNamesTheFoldersSearched) {
  test::write_log(options_.log, {test::external_image("CAM", 0, "a.png")});
  expect_fault({"drive_Images", "drive_images", "/Images", "--images-dir"});
}

TEST_F(SourceErrors, ImageOfAnotherSizeThanItsCalibration) {
  test::write_log(options_.log, {test::external_image("CAM", 0, "a.png")});
  cv::imwrite((folder_.path() / "a.png").string(), cv::Mat(20, 30, CV_8U, cv::Scalar(9)));
  expect_fault({"a.png", "30x20", "64x48", "--calibration"});
}

TEST_F(SourceErrors, UnreadableImageIsNamed) {
  test::write_log(options_.log, {test::external_image("CAM", 0, "a.png")});
  test::write_bytes(folder_.path() / "a.png", "no image");
  expect_fault({"a.png", "cannot be decoded"});
}

TEST_F(SourceErrors, LogWithoutCalibration) {
  auto image = test::stored_image("CAM", 0, ramp(0));
  image->cameraParams = mrpt::img::TCamera();
  test::write_log(options_.log, {image});
  expect_fault({"record 0", "CAM", "no calibration", "--calibration"});
}

TEST_F(SourceErrors, LensThatNoModelDescribes) {
  auto image = test::stored_image("CAM", 0, ramp(0));
  image->cameraParams.distortion = mrpt::img::DistortionModel::kannala_brandt;
  image->cameraParams.dist = {0.1, 0, 1, 1, 1, 1, 0, 0};
  test::write_log(options_.log, {image});
  expect_fault({"fisheye lens has more than four terms", "--calibration"});
}

TEST_F(SourceErrors, CalibrationThatChangesWithinTheLog) {
  auto other = test::stored_image("CAM", 1, ramp(0));
  other->cameraParams.fx(60);
  test::write_log(options_.log, {test::stored_image("CAM", 0, ramp(0)), other});
  expect_fault({"record 1", "changes"});
}

TEST_F(SourceErrors, ImageWithoutTimeStamp) {
  auto image = test::stored_image("CAM", 0, ramp(0));
  image->timestamp = INVALID_TIMESTAMP;
  test::write_log(options_.log, {image});
  expect_fault({"record 0", "time stamp"});
}

TEST_F(SourceErrors, TheFirstImageDecidesOnTheSizeWhicheverIsLoadedFirst) {
  cv::Mat small;
  cv::resize(ramp(0), small, cv::Size(32, 24));
  test::write_log(options_.log,
                  {test::stored_image("CAM", 0, ramp(0)), test::stored_image("CAM", 1, small)});
  test::write_bytes(folder_.path() / "cameras.txt", "1 PINHOLE 128 96 100 100 64 48\n");
  options_.calibration = (folder_.path() / "cameras.txt").string();
  RawlogSource source(options_);
  const auto first = source.next(), second = source.next();
  const std::string said = test::input_error([&] { static_cast<void>(source.load(*second)); });
  EXPECT_NE(said.find("size of the images changes"), std::string::npos) << said;
  EXPECT_DOUBLE_EQ(source.load(*first).camera.fx, 50.0);
}

TEST_F(SourceErrors, ViewThatNoPinholeImageHas) {
  for (const double fov : {5.0, 170.0, -90.0, std::nan("")}) {
    options_.undistorted_fov_deg = fov;
    expect_fault({"--undistorted-fov", "from 10 to 150"});
  }
}

TEST_F(SourceErrors, OptionsOutOfBounds) {
  options_.every = 0;
  expect_fault({"--every 0", "at least 1"});
  options_.every = 1;
  options_.mount_convention = "sideways";
  expect_fault({"sideways", "x_forward"});
}

TEST_F(SourceErrors, TruncatedGzipGivesWhatIsBeforeTheCutAndSaysSo) {
  test::Objects objects;
  for (int i = 0; i < 200; ++i) objects.push_back(test::stored_image("CAM", 0.1 * i, ramp(i)));
  std::string bytes = test::packed(objects, Packing::gzip);
  bytes.resize(bytes.size() / 2);
  test::write_bytes(options_.log, bytes);
  RawlogSource source(options_);
  std::size_t frames = 0;
  while (auto ticket = source.next()) frames += source.load(*ticket).image.empty() ? 0 : 1;
  EXPECT_GT(frames, 50U);
  EXPECT_LT(frames, 150U);
  const auto& damage = source.report().damage;
  EXPECT_NE(damage.find("drive.rawlog: record " + std::to_string(frames)), std::string::npos);
  EXPECT_NE(damage.find("gzip data ends early"), std::string::npos) << damage;
}

}  // namespace
}  // namespace oneac
