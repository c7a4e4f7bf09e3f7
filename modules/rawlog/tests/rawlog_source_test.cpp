#include "oneac/rawlog/rawlog_source.h"

#include "log_maker.h"

#include "oneac/geometry/levelling.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>

namespace oneac {
namespace {

using test::Packing;
using test::ramp;

class Source : public ::testing::Test {
 protected:
  void save(const std::filesystem::path& name, int level) {
    std::filesystem::create_directories((folder_.path() / name).parent_path());
    cv::imwrite((folder_.path() / name).string(), ramp(level));
  }
  // Five pairs, one every 0.05 s, external, none of the images there yet.
  void write_pairs() {
    test::Objects objects;
    for (int i = 0; i < 5; ++i) {
      objects.push_back(test::external_pair("CAM", 0.05 * i, "p" + std::to_string(i)));
    }
    test::write_log(options_.log, objects, Packing::gzip);
  }
  std::vector<CameraFrame> all() {
    std::vector<CameraFrame> frames;
    RawlogSource source(options_);
    while (auto ticket = source.next()) frames.push_back(source.load(*ticket));
    source.finish();
    report_ = source.report();
    return frames;
  }
  static int level(const CameraFrame& frame) { return frame.image.row(0)[0]; }

  TemporaryFolder folder_;
  SourceOptions options_{folder_.path() / "drive.rawlog", {}, "", "", "auto", {}, 0, 0, 1};
  SourceReport report_;
};

TEST_F(Source, DeliversStoredImagesWithTimeCalibrationAndPose) {
  test::write_log(options_.log, {test::stored_image("CAM", 0.0, ramp(10)),
                                 test::stored_image("CAM", 0.1, ramp(20))});
  const auto frames = all();
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[1].index, 1U);
  EXPECT_NEAR(frames[1].time_s, test::kStart + 0.1, 1e-6);
  EXPECT_EQ(frames[1].name, "record 1");
  EXPECT_NEAR(level(frames[1]), 20, 3) << "MRPT stores JPEG";
  EXPECT_EQ(frames[0].camera.width, test::kWidth);
  EXPECT_DOUBLE_EQ(frames[0].camera.fx, 50);
  EXPECT_TRUE(frames[0].T_vehicle_cam.isApprox(CameraFrame::forward_looking_mount()));
  EXPECT_EQ(report_.images_in_log, 2U);
  EXPECT_EQ(report_.images_missing, 0U);
}

TEST_F(Source, KeepsTheGreyLevelsOfADriveInWhateverOrderImagesAreLoaded) {
  cv::Mat day, night;
  ramp(150).convertTo(day, CV_16U, 16.0);  // 12 bits
  ramp(10).convertTo(night, CV_16U, 8.0);  // by itself 10 bits
  cv::imwrite((folder_.path() / "day.png").string(), day);
  cv::imwrite((folder_.path() / "night.png").string(), night);
  test::write_log(options_.log, {test::external_image("CAM", 0.0, "day.png"),
                                 test::external_image("CAM", 0.1, "night.png")});
  options_.images_dir = folder_.path();
  for (const bool in_turn : {true, false}) {
    RawlogSource source(options_);
    const auto first = source.next(), second = source.next();
    if (in_turn) static_cast<void>(source.load(*first));
    EXPECT_EQ(level(source.load(*second)), 5) << in_turn;
    EXPECT_EQ(level(source.load(*first)), 150) << in_turn;
  }
}

TEST_F(Source, CountsMissingImagesOnceAndKeepsTheirIndex) {
  write_pairs();
  save("Images/p1_right.png", 1);
  save("Images/p3_right.png", 3);
  options_.camera = "right";
  const auto frames = all();
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].index, 1U);
  EXPECT_EQ(frames[1].index, 3U);
  EXPECT_EQ(level(frames[1]), 3);
  EXPECT_EQ(report_.images_in_log, 5U);
  EXPECT_EQ(report_.images_missing, 3U);
  EXPECT_EQ(report_.first_missing, "p0_right.png");
}

TEST_F(Source, SaysThatNamesDoNotFollowTheTime) {
  std::vector<std::string> names;
  for (int i = 1; i <= 25; ++i) names.push_back(std::to_string(i) + ".png");
  for (const bool sorted_as_text : {false, true}) {
    if (sorted_as_text) std::sort(names.begin(), names.end());
    test::Objects objects;
    for (std::size_t i = 0; i < names.size(); ++i) {
      save("Images/" + names[i], static_cast<int>(i));
      objects.push_back(test::external_image("CAM", 0.1 * static_cast<double>(i), names[i]));
    }
    test::write_log(options_.log, objects);
    ASSERT_EQ(all().size(), names.size());
    const std::string& said = report_.names_out_of_order;
    EXPECT_EQ(said.empty(), !sorted_as_text) << said;
    EXPECT_EQ(said.find("nothing is in metres") != std::string::npos, sorted_as_text) << said;
  }
}

TEST_F(Source, RefusesTwoCamerasUnderOneLabel) {
  test::Objects objects;
  for (int i = 0; i < 6; ++i) {
    auto image = test::stored_image("CAM", 0.1 * i, ramp(10));
    image->cameraPose = mrpt::poses::CPose3D(0, i % 2 == 0 ? 0.3 : -0.3, 1.5, 0, 0, 0);
    objects.push_back(image);
  }
  test::write_log(options_.log, objects);
  const std::string said = test::input_error([&] { (void)all(); });
  EXPECT_NE(said.find("two cameras have one label"), std::string::npos) << said;
}

TEST_F(Source, SearchesTheFoldersInOrder) {
  write_pairs();
  options_.camera = "left";
  const auto first_level = [&] { return level(all().at(0)); };
  save("p0_left.png", 5);
  EXPECT_EQ(first_level(), 5);
  save("Images/p0_left.png", 4);
  EXPECT_EQ(first_level(), 4);
  save("drive_images/p0_left.png", 3);
  EXPECT_EQ(first_level(), 3);
  save("drive_Images/p0_left.png", 2);
  EXPECT_EQ(first_level(), 2);
  save("elsewhere/p0_left.png", 1);
  options_.images_dir = folder_.path() / "elsewhere";
  EXPECT_EQ(first_level(), 1);
}

TEST_F(Source, TakesAbsoluteNamesAsTheyAreAndFindsThemAfterAMove) {
  save("far/a.png", 7);
  test::write_log(options_.log, {test::external_image("CAM", 0, folder_.path() / "far/a.png")});
  EXPECT_EQ(level(all().at(0)), 7);
  std::filesystem::rename(folder_.path() / "far", folder_.path() / "moved");
  options_.images_dir = folder_.path() / "moved";
  EXPECT_EQ(level(all().at(0)), 7);
}

TEST_F(Source, OfAPairTakesTheLeftImagesUnlessOnlyRightOnesExist) {
  write_pairs();
  save("p2_right.png", 2);
  EXPECT_EQ(all().at(0).name, "p2_right.png");
  save("p4_left.png", 4);
  EXPECT_EQ(all().at(0).name, "p4_left.png");
  options_.camera = "CAM/right";
  EXPECT_EQ(all().at(0).name, "p2_right.png");
  options_.camera = "CAM";
  EXPECT_EQ(all().at(0).name, "p4_left.png");
}

TEST_F(Source, ChoosesAmongLabels) {
  test::write_log(options_.log,
                  {test::stored_image("A", 0, ramp(10)), test::stored_image("B", 0, ramp(90))});
  options_.camera = "B";
  const auto frames = all();
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_NEAR(level(frames[0]), 90, 3);
}

TEST_F(Source, ThinsByFirstEveryAndCountWithoutChangingTheIndex) {
  test::Objects objects;
  for (int i = 0; i < 12; ++i) objects.push_back(test::stored_image("CAM", 0.1 * i, ramp(i)));
  test::write_log(options_.log, objects, Packing::zstd);
  options_.first = 2;
  options_.every = 3;
  options_.count = 3;
  const auto frames = all();
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[0].index, 2U);
  EXPECT_EQ(frames[1].index, 5U);
  EXPECT_EQ(frames[2].index, 8U);
}

TEST_F(Source, ReadsSensoryFrames) {
  auto frame = mrpt::obs::CSensoryFrame::Create();
  *frame += mrpt::obs::CObservation::Ptr(test::stored_image("CAM", 0, ramp(10)));
  test::write_log(options_.log, {frame, test::stored_image("CAM", 1, ramp(20))});
  EXPECT_EQ(all().size(), 2U);
}

TEST_F(Source, GathersTheReferenceUpToTwoSecondsPastTheLastImage) {
  test::Objects objects{test::rmc(0, 10, 0), test::stored_image("CAM", 0.5, ramp(10))};
  for (int i = 1; i < 10; ++i) objects.push_back(test::rmc(i, 10, i));
  test::write_log(options_.log, objects);
  options_.count = 1;
  all();
  EXPECT_EQ(report_.reference.gps.size(), 4U) << "0, 1, 2 s and the first beyond 2.5 s";
  EXPECT_TRUE(report_.reference.heading_change(0.5 + test::kStart, 2.5 + test::kStart));
}

TEST_F(Source, UndistortsRawImages) {
  auto raw = test::calibration();
  raw.setDistortionPlumbBob(-0.3, 0.1, 0.002, -0.001);
  // A linear grey ramp over the rectified image plane, seen through the lens.
  const cv::Matx33d K(50, 0, 32, 0, 50, 24, 0, 0, 1);
  const cv::Mat k = (cv::Mat_<double>(1, 5) << -0.3, 0.1, 0.002, -0.001, 0);
  const auto grey_at = [](double u, double v) { return 20.0 + 2.5 * u + 0.5 * v; };
  cv::Mat seen(test::kHeight, test::kWidth, CV_8U);
  for (int v = 0; v < seen.rows; ++v) {
    for (int u = 0; u < seen.cols; ++u) {
      std::vector<cv::Point2d> rectified;
      cv::undistortPoints(std::vector<cv::Point2d>{cv::Point2d(u, v)}, rectified, K, k,
                          cv::noArray(), K);
      seen.at<std::uint8_t>(v, u) =
          cv::saturate_cast<std::uint8_t>(grey_at(rectified[0].x, rectified[0].y));
    }
  }
  cv::imwrite((folder_.path() / "a.png").string(), seen);
  auto observation = test::external_image("CAM", 0, "a.png");
  observation->cameraParams = raw;
  test::write_log(options_.log, {observation});
  const auto frame = all().at(0);
  EXPECT_FALSE(frame.camera.is_distorted());
  EXPECT_DOUBLE_EQ(frame.camera.fx, 50);
  for (const int u : {12, 32, 52}) {
    for (const int v : {10, 24, 38}) EXPECT_NEAR(frame.image.row(v)[u], grey_at(u, v), 2.0);
  }
  EXPECT_GT(std::abs(seen.at<std::uint8_t>(10, 12) - grey_at(12, 10)), 2.0) << "the test is blunt";
}

TEST_F(Source, MasksWhatUndistortionLeavesBlack) {
  auto observation = test::external_image("CAM", 0, "a.png");
  observation->cameraParams.setDistortionPlumbBob(0.9, 0.5, 0, 0);
  cv::imwrite((folder_.path() / "a.png").string(),
              cv::Mat(test::kHeight, test::kWidth, CV_8U, cv::Scalar(200)));
  test::write_log(options_.log, {observation});
  const auto frame = all().at(0);
  ASSERT_FALSE(frame.mask.empty());
  EXPECT_EQ(frame.image.row(1)[1], 0);
  EXPECT_EQ(frame.mask.row(1)[1], 0);
  EXPECT_EQ(frame.mask.row(24)[32], 255);
}

TEST_F(Source, CalibrationOverrideLeavesRectifiedImagesAlone) {
  auto observation = test::external_image("CAM", 0, "a.png");
  observation->cameraParams.setDistortionPlumbBob(-0.3, 0.1, 0, 0);
  test::write_log(options_.log, {observation});
  save("a.png", 30);
  test::write_bytes(folder_.path() / "calib.txt", "P0: 60 0 31 0 0 61 23 0 0 0 1 0\n");
  options_.calibration = (folder_.path() / "calib.txt").string();
  const auto frame = all().at(0);
  EXPECT_DOUBLE_EQ(frame.camera.fy, 61);
  EXPECT_EQ(frame.camera.width, test::kWidth);
  for (int u = 0; u < test::kWidth; ++u) EXPECT_EQ(frame.image.row(5)[u], 30 + u);
}

TEST_F(Source, PlacesTheRightCameraABaselineToTheRightAndKeepsTheTilt) {
  auto pair = test::external_pair("CAM", 0, "p");
  pair->cameraPose =
      mrpt::poses::CPose3DQuat(mrpt::poses::CPose3D(0.785, 0, 0.273, 0, -8.2 * M_PI / 180, 0));
  test::write_log(options_.log, {pair});
  save("p_right.png", 1);
  options_.camera = "right";
  const auto T = all().at(0).T_vehicle_cam;
  EXPECT_TRUE(T.translation().isApprox(Eigen::Vector3d(0.785, -0.12, 0.273), 1e-9));
  EXPECT_NEAR(tilt_from_mounting(T.linear()).pitch_up, 8.2 * M_PI / 180, 1e-9);
}

}  // namespace
}  // namespace oneac
