#include "oneac/rawlog/import_kitti.h"

#include "writing_support.h"

#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationImage.h>

#include <cmath>

namespace oneac {
namespace {

namespace fs = std::filesystem;
using mrpt::obs::CObservationImage;
using test::complaint_of;
using test::write_text;

constexpr const char* kCalibration =
    "P0: 7.2e+02 0 6.1e+02 0 0 7.2e+02 1.7e+02 0 0 0 1 0\n"
    "P2: 7.1e+02 0 6.0e+02 44.8 0 7.1e+02 1.8e+02 0.2 0 0 1 0\n";

class ImportKitti : public ::testing::Test {
 protected:
  ImportKitti() {
    options_.source = folder_.path() / "03";
    options_.log = folder_.path() / "out" / "k03.rawlog";
    fs::create_directories(options_.source);
  }
  void make_sequence(int first = 0, int count = 3, const std::string& images = "image_0") {
    for (int i = first; i < first + count; ++i) {
      test::write_image(options_.source / images / ("00000" + std::to_string(i) + ".png"));
    }
    write_text(options_.source / "calib.txt", kCalibration);
    write_text(options_.source / "times.txt", "0.0e+00\n1.036e-01\n2.072e-01\n3.1e-01\n");
    write_text(options_.source / "poses.txt",
               "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 1\n"
               "1 0 0 0 0 1 0 0 0 0 1 2\n1 0 0 0 0 1 0 0 0 0 1 3\n");
  }
  [[nodiscard]] std::vector<CObservationImage::Ptr> images() const {
    return test::only<CObservationImage>(test::read_with_mrpt(options_.log));
  }
  [[nodiscard]] std::string complaint() const {
    return complaint_of([this] { import_kitti(options_); });
  }

  TemporaryFolder folder_;
  KittiImport options_;
};

TEST_F(ImportKitti, RawlogEditReadsTheLog) {
  make_sequence();
  import_kitti(options_);
  const std::string info = test::rawlog_edit_info(options_.log);
  EXPECT_NE(info.find("Overall number of objects         : 3"), std::string::npos) << info;
  EXPECT_NE(info.find("All sensor labels                 : image_0"), std::string::npos) << info;
}

TEST_F(ImportKitti, ImagesAreReferredToByTheirAbsolutePath) {
  make_sequence();
  const ImportReport report = import_kitti(options_);
  EXPECT_EQ(report.images, 3U);
  const auto stored = fs::path(images().at(1)->image.getExternalStorageFile());
  EXPECT_TRUE(stored.is_absolute());
  EXPECT_TRUE(fs::equivalent(stored, options_.source / "image_0" / "000001.png"));
}

TEST_F(ImportKitti, CopiesImagesOnRequest) {
  make_sequence();
  options_.copy_images = true;
  import_kitti(options_);
  EXPECT_EQ(images().at(2)->image.getExternalStorageFile(), "000002.png");
  EXPECT_EQ(test::names_in(folder_.path() / "out" / "k03_Images"),
            (std::vector<std::string>{"000000.png", "000001.png", "000002.png"}));
}

TEST_F(ImportKitti, StoresCalibrationAndMounting) {
  make_sequence();
  options_.camera_height_m = 1.7;
  import_kitti(options_);
  const auto image = images().at(0);
  EXPECT_EQ(image->cameraParams.ncols, 64U);
  EXPECT_EQ(image->cameraParams.nrows, 48U);
  EXPECT_EQ(image->cameraParams.fx(), 720.0);
  EXPECT_EQ(image->cameraParams.cy(), 170.0);
  EXPECT_NEAR(image->cameraPose.z(), 1.7, 1e-12);
  EXPECT_NEAR(image->cameraPose.yaw(), -M_PI / 2, 1e-9);
  EXPECT_NEAR(image->cameraPose.roll(), -M_PI / 2, 1e-9);
}

TEST_F(ImportKitti, TheColourCameraHasItsOwnCalibration) {
  make_sequence(0, 3, "image_2");
  import_kitti(options_);
  EXPECT_EQ(images().at(0)->cameraParams.fx(), 710.0);
  EXPECT_EQ(images().at(0)->sensorLabel, "image_2");
}

TEST_F(ImportKitti, TimesAndPosesBelongToTheImagesByNumber) {
  make_sequence(1, 3);
  const ImportReport report = import_kitti(options_);
  const auto stored = images();
  ASSERT_EQ(stored.size(), 3U);
  const double step =
      mrpt::Clock::toDouble(stored[2]->timestamp) - mrpt::Clock::toDouble(stored[0]->timestamp);
  EXPECT_NEAR(step, 0.31 - 0.1036, 1e-6);
  EXPECT_EQ(report.poses, folder_.path() / "out" / "k03_poses.txt");
  EXPECT_EQ(test::read_text(report.poses),
            "1 0 0 0 0 1 0 0 0 0 1 1\n1 0 0 0 0 1 0 0 0 0 1 2\n1 0 0 0 0 1 0 0 0 0 1 3\n");
}

TEST_F(ImportKitti, WithoutTimesItIsTenHertzAndSaysSo) {
  make_sequence();
  fs::remove(options_.source / "times.txt");
  const ImportReport report = import_kitti(options_);
  ASSERT_EQ(report.notes.size(), 1U);
  EXPECT_NE(report.notes[0].find("10 Hz"), std::string::npos);
  const auto stored = images();
  EXPECT_NEAR(mrpt::Clock::toDouble(stored.at(1)->timestamp) -
                  mrpt::Clock::toDouble(stored.at(0)->timestamp),
              0.1, 1e-6);
}

TEST_F(ImportKitti, TooFewTimesAreAnError) {
  make_sequence();
  write_text(options_.source / "times.txt", "0\n0.1\n");
  EXPECT_NE(complaint().find("times.txt: 2 rows for 3 images"), std::string::npos) << complaint();
  EXPECT_FALSE(fs::exists(options_.log));
}

TEST_F(ImportKitti, TimesThatDoNotIncreaseAreAnError) {
  make_sequence();
  write_text(options_.source / "times.txt", "0\n0.2\n0.1\n");
  EXPECT_NE(complaint().find("row 3"), std::string::npos) << complaint();
}

TEST_F(ImportKitti, TooFewPosesAreLeftOutAndNoted) {
  make_sequence();
  write_text(options_.source / "poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  const ImportReport report = import_kitti(options_);
  EXPECT_TRUE(report.poses.empty());
  ASSERT_EQ(report.notes.size(), 1U);
  EXPECT_NE(report.notes[0].find("poses.txt"), std::string::npos);
}

TEST_F(ImportKitti, ADamagedRowIsNamed) {
  make_sequence();
  write_text(options_.source / "times.txt", "0\n0.1x\n0.2\n");
  EXPECT_NE(complaint().find("line 2"), std::string::npos) << complaint();
}

TEST_F(ImportKitti, NamesTheMissingCalibration) {
  make_sequence();
  fs::remove(options_.source / "calib.txt");
  EXPECT_NE(complaint().find("calib.txt: no such file"), std::string::npos) << complaint();
}

TEST_F(ImportKitti, SaysWhereItLookedForImages) {
  EXPECT_NE(complaint().find("image_0, image_l, image_2 or images"), std::string::npos);
  options_.source = folder_.path() / "nowhere";
  EXPECT_NE(complaint().find("no such folder"), std::string::npos);
}

TEST_F(ImportKitti, AFileThatIsNoImageIsNamed) {
  make_sequence();
  write_text(options_.source / "image_0" / "000000.png", "no image");
  EXPECT_NE(complaint().find("000000.png"), std::string::npos) << complaint();
}

}  // namespace
}  // namespace oneac
