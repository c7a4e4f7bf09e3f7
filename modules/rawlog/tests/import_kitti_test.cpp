#include "oneac/rawlog/import_kitti.h"

#include "writing_support.h"

#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationImage.h>

#include <algorithm>
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
    options_.camera_height_m = 1.65;
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

TEST_F(ImportKitti, TakesNoHeightThatNobodyGave) {
  make_sequence();  // 64x48 images: not KITTI's
  options_.camera_height_m.reset();
  const ImportReport report = import_kitti(options_);
  EXPECT_EQ(images().at(0)->cameraPose.z(), 0.0);
  ASSERT_FALSE(report.notes.empty());
  EXPECT_NE(report.notes.back().find("give --camera-height"), std::string::npos);
}

TEST_F(ImportKitti, TakesKittisHeightForKittisCameraAndSaysSo) {
  make_sequence();
  options_.camera_height_m.reset();
  for (int i = 0; i < 3; ++i) {
    test::write_image(options_.source / "image_0" / ("00000" + std::to_string(i) + ".png"), 1242,
                      375);
  }
  write_text(options_.source / "calib.txt",
             "P0: 721.5377 0 609.5593 0 0 721.5377 172.854 0 0 0 1 0\n");
  const ImportReport report = import_kitti(options_);
  EXPECT_NEAR(images().at(0)->cameraPose.z(), 1.65, 1e-12);
  EXPECT_NE(report.notes.back().find("1.65 m is taken"), std::string::npos);
  write_text(options_.source / "calib.txt", "P0: 725 0 609.5593 0 0 725 172.854 0 0 0 1 0\n");
  import_kitti(options_);
  EXPECT_EQ(images().at(0)->cameraPose.z(), 0.0) << "another camera with images of this size";
}

TEST_F(ImportKitti, RefusesHeightsOfNoVehicle) {
  make_sequence();
  for (const double height : {165.0, 0.0, -1.65, 0.2, 5.5, 1e17, std::nan(""), 1.0 / 0.0}) {
    options_.camera_height_m = height;
    EXPECT_NE(complaint().find("from 0.3 to 5"), std::string::npos) << height;
  }
  for (const double height : {0.3, 3.5, 5.0}) {
    options_.camera_height_m = height;
    EXPECT_EQ(complaint(), "") << height;
  }
}

TEST_F(ImportKitti, WritesTheMountIntoTheLog) {
  make_sequence();
  options_.mount = {180.0, 5.0, 90.0};
  for (const auto convention : {MountConvention::optical, MountConvention::x_forward}) {
    options_.convention = convention;
    import_kitti(options_);
    const auto pose = images()
                          .at(0)
                          ->cameraPose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>()
                          .asEigen()
                          .eval();
    const SensorMount mount =
        mount_from_sensor_pose(Eigen::Isometry3d(pose), to_string(convention));
    EXPECT_TRUE(mount.T_vehicle_cam.linear().isApprox(mount_rotation(options_.mount), 1e-6));
  }
  options_.mount.pitch_up_deg = 95.0;
  EXPECT_NE(complaint().find("--mount-pitch"), std::string::npos);
}

TEST_F(ImportKitti, ReplacesPosesOnlyWithTheLogThatTheyLieBeside) {
  make_sequence();
  const fs::path poses = import_kitti(options_).poses;
  ASSERT_TRUE(fs::exists(poses));
  EXPECT_EQ(import_kitti(options_).poses, poses) << "log and poses together are of an import";
  fs::remove(options_.log);
  write_text(poses, "somebody's own");
  EXPECT_NE(complaint().find(poses.filename().string() + ": is there without its log"),
            std::string::npos)
      << complaint();
  EXPECT_FALSE(fs::exists(options_.log));
  EXPECT_EQ(fs::file_size(poses), std::string("somebody's own").size());
}

TEST_F(ImportKitti, SaysThatTimesHaveADecimalPoint) {
  make_sequence();
  write_text(options_.source / "times.txt", "0,0\n0,1\n0,2\n");
  EXPECT_NE(complaint().find("write a decimal point where the numbers have a comma"),
            std::string::npos)
      << complaint();
  write_text(options_.source / "times.txt", "0,0\n0,9\n1,8\n");
  EXPECT_NE(complaint().find("write a decimal point where the numbers have a comma"),
            std::string::npos)
      << complaint();
}

TEST_F(ImportKitti, OrdersImagesByTheirNumbersAndSaysSo) {
  make_sequence(0, 0);
  for (const char* name : {"1.png", "2.png", "9.png", "10.png", "11.png", "100.png"}) {
    test::write_image(options_.source / "images" / name);
  }
  fs::remove(options_.source / "times.txt");
  fs::remove(options_.source / "poses.txt");
  options_.copy_images = true;
  const ImportReport report = import_kitti(options_);
  std::vector<std::string> order;
  for (const auto& image : images()) order.push_back(image->image.getExternalStorageFile());
  EXPECT_EQ(order,
            (std::vector<std::string>{"1.png", "2.png", "9.png", "10.png", "11.png", "100.png"}));
  const auto& notes = report.notes;
  EXPECT_EQ(std::count_if(notes.begin(), notes.end(),
                          [](const std::string& note) {
                            return note.find("numbers in their names: 1.png to 100.png") !=
                                   std::string::npos;
                          }),
            1);
}

TEST_F(ImportKitti, RecognisesTheUnitOfTimesAndSaysIt) {
  struct Case {
    const char* times;
    const char* unit;
    double first_s;
  };
  make_sequence();
  for (const Case& c :
       {Case{"1317016800000000000\n1317016800100000000\n1317016800200000000\n", "nanoseconds",
             1317016800.0},
        Case{"1317016800000000\n1317016800100000\n1317016800200000\n", "microseconds",
             1317016800.0},
        Case{"1317016800000\n1317016800100\n1317016800200\n", "milliseconds", 1317016800.0},
        Case{"0\n100000000\n200000000\n", "nanoseconds", 1317016800.0},
        Case{"0\n100000\n200000\n", "microseconds", 1317016800.0},
        Case{"0\n100\n200\n", "milliseconds", 1317016800.0},
        Case{"1400000000.0\n1400000000.1\n1400000000.2\n", "", 1400000000.0}}) {
    write_text(options_.source / "times.txt", c.times);
    const ImportReport report = import_kitti(options_);
    const auto found = images();
    ASSERT_EQ(found.size(), 3U);
    const double first = mrpt::Clock::toDouble(found[0]->timestamp);
    EXPECT_NEAR(first, c.first_s, 1e-5) << c.times;
    EXPECT_NEAR(mrpt::Clock::toDouble(found[2]->timestamp) - first, 0.2, 1e-5) << c.times;
    std::string notes;
    for (const std::string& note : report.notes) notes += note + '\n';
    const bool said = notes.find("times.txt is in ") != std::string::npos;
    EXPECT_EQ(said, c.unit[0] != '\0') << notes;
    EXPECT_NE(notes.find(c.unit), std::string::npos) << notes;
  }
}

TEST_F(ImportKitti, RefusesTimesOfNoUnitByRow) {
  make_sequence();
  write_text(options_.source / "times.txt", "0\n1e-5\n2e-5\n");
  EXPECT_NE(complaint().find("no spacing of images"), std::string::npos) << complaint();
  for (const char* beyond : {"1e300", "-1e300", "-0.1", "1e10"}) {
    write_text(options_.source / "times.txt", std::string("0\n0.1\n") + beyond + "\n");
    const std::string said = complaint();
    EXPECT_NE(said.find("times.txt"), std::string::npos) << beyond;
    EXPECT_NE(said.find("10 Hz"), std::string::npos) << said;
  }
  write_text(options_.source / "times.txt", "0\n0.1\n0.2\n-1e300\n");
  EXPECT_NE(complaint().find("row 4"), std::string::npos) << complaint();
}

TEST_F(ImportKitti, RefusesAPoseThatIsNone) {
  make_sequence();
  write_text(options_.source / "poses.txt",
             "1 0 0 0 0 1 0 0 0 0 1 0\n0 0 0 0 0 0 0 0 0 0 0 0\n1 0 0 0 0 1 0 0 0 0 1 2\n");
  EXPECT_NE(complaint().find("row 2: is no rotation"), std::string::npos) << complaint();
  write_text(options_.source / "poses.txt",
             "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 1\n1 0 0 0 0 1 0 0 0 0 1 1e30\n");
  EXPECT_NE(complaint().find("row 3: lies 1e15 m away"), std::string::npos) << complaint();
}

TEST_F(ImportKitti, RefusesAFirstImageOfOnePixel) {
  make_sequence();
  test::write_image(options_.source / "image_0" / "000000.png", 1, 1);
  const std::string said = complaint();
  EXPECT_NE(said.find("000000.png"), std::string::npos) << said;
  EXPECT_NE(said.find("1x1 pixels"), std::string::npos) << said;
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

TEST_F(ImportKitti, FindsThePosesInKittisOwnLayout) {
  options_.source = folder_.path() / "dataset" / "sequences" / "03";
  make_sequence();
  fs::create_directories(folder_.path() / "dataset" / "poses");
  fs::rename(options_.source / "poses.txt", folder_.path() / "dataset" / "poses" / "03.txt");
  EXPECT_EQ(import_kitti(options_).poses, folder_.path() / "out" / "k03_poses.txt");
}

TEST_F(ImportKitti, PassesOverWhatMacosLeavesBesideImages) {
  make_sequence();
  write_text(options_.source / "image_0" / "._000000.png", "no image");
  EXPECT_EQ(import_kitti(options_).images, 3U);
}

TEST_F(ImportKitti, ReadsBitmapsAndPortableMaps) {
  for (const char* kind : {".bmp", ".pgm", ".ppm", ".JPG"}) {
    make_sequence();
    fs::rename(options_.source / "image_0" / "000001.png",
               options_.source / "image_0" / ("000001" + std::string(kind)));
    EXPECT_EQ(import_kitti(options_).images, 3U) << kind;
    fs::remove_all(options_.source / "image_0");
  }
}

TEST_F(ImportKitti, SaysWhichImagesItDoesNotRead) {
  make_sequence();
  for (const char* name : {"000000", "000001", "000002"}) {
    const fs::path image = options_.source / "image_0" / name;
    fs::rename(image.string() + ".png", image.string() + ".heic");
  }
  EXPECT_NE(complaint().find("3 .heic"), std::string::npos) << complaint();
  EXPECT_NE(complaint().find("convert them"), std::string::npos) << complaint();
}

TEST_F(ImportKitti, RefusesOneImageInTwoFormats) {
  make_sequence();
  fs::copy_file(options_.source / "image_0" / "000001.png",
                options_.source / "image_0" / "000001.jpg");
  EXPECT_NE(complaint().find("000001"), std::string::npos) << complaint();
  EXPECT_NE(complaint().find("beside"), std::string::npos) << complaint();
}

TEST_F(ImportKitti, RefusesOneNumberTwice) {
  make_sequence();
  fs::copy_file(options_.source / "image_0" / "000001.png", options_.source / "image_0" / "1.png");
  EXPECT_NE(complaint().find("1.png"), std::string::npos) << complaint();
  EXPECT_NE(complaint().find("beside"), std::string::npos) << complaint();
}

TEST_F(ImportKitti, RefusesASkewAndWhatNoCameraHas) {
  make_sequence();
  write_text(options_.source / "calib.txt", "P0: 720 99 610 0 0 720 170 0 0 0 1 0\n");
  EXPECT_NE(complaint().find("99"), std::string::npos) << complaint();
  write_text(options_.source / "calib.txt", "P0: 1e300 0 610 0 0 720 170 0 0 0 1 0\n");
  EXPECT_NE(complaint().find("1e+300"), std::string::npos) << complaint();
}

TEST_F(ImportKitti, RefusesAnImageThatIsALinkToNothing) {
  make_sequence();
  fs::create_symlink("nowhere.png", options_.source / "image_0" / "000003.png");
  EXPECT_NE(complaint().find("000003.png: is a link to nothing"), std::string::npos);
}

TEST_F(ImportKitti, APlaceOfPosesThatIsNoFileCostsNoLog) {
  make_sequence();
  fs::create_directories(folder_.path() / "out" / "k03_poses.txt");
  EXPECT_NE(complaint().find("k03_poses.txt"), std::string::npos) << complaint();
  EXPECT_FALSE(fs::exists(options_.log));
}

TEST_F(ImportKitti, RefusesAGivenCalibrationThatNoCameraHas) {
  make_sequence();
  options_.calibration = (folder_.path() / "given.txt").string();
  write_text(options_.calibration, "P0: 1e300 0 610 0 0 720 170 0 0 0 1 0\n");
  EXPECT_NE(complaint().find("1e+300"), std::string::npos) << complaint();
  EXPECT_FALSE(fs::exists(options_.log));
}

TEST_F(ImportKitti, WritesThroughALinkAndReplacesNothingButFiles) {
  make_sequence();
  fs::create_directories(folder_.path() / "out");
  fs::create_directories(folder_.path() / "far");
  fs::create_symlink("../far/log", options_.log);
  import_kitti(options_);
  EXPECT_TRUE(fs::is_symlink(options_.log));
  EXPECT_EQ(images().size(), 3U);
  fs::remove(options_.log);
  fs::remove(folder_.path() / "out" / "k03_poses.txt");
  fs::create_symlink("/dev/null", options_.log);
  EXPECT_NE(complaint().find("a device"), std::string::npos) << complaint();
  EXPECT_FALSE(fs::exists(folder_.path() / "out" / "k03_poses.txt"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

}  // namespace
}  // namespace oneac
