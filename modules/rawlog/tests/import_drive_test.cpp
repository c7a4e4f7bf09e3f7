#include "oneac/rawlog/import_drive.h"

#include "writing_support.h"

#include "oneac/rawlog/import_kitti.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <mrpt/obs/gnss_messages.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include <cmath>
#include <fstream>
#include <iterator>
#include <map>

namespace oneac {
namespace {

namespace fs = std::filesystem;
using mrpt::obs::CObservationGPS;
using mrpt::obs::CObservationImage;
using mrpt::obs::CObservationIMU;
using mrpt::obs::CObservationStereoImages;
using test::complaint_of;
using test::write_text;

class ImportDrive : public ::testing::Test {
 protected:
  ImportDrive() {
    options_.source = folder_.path() / "drive";
    options_.log = folder_.path() / "out" / "drive.rawlog";
    options_.calibration = (folder_.path() / "cameras.txt").string();
    options_.camera_height_m = 1.4;
    write_text(options_.calibration, "1 PINHOLE 64 48 50 51 32.5 24.5\n");
    fs::create_directories(options_.source);
  }
  void make_images(const std::vector<std::string>& names) {
    for (const std::string& name : names) test::write_image(options_.source / name);
  }
  template <class Observation>
  [[nodiscard]] std::vector<std::shared_ptr<Observation>> stored() const {
    return test::only<Observation>(test::read_with_mrpt(options_.log));
  }
  [[nodiscard]] std::vector<double> times() const {
    std::vector<double> all;
    for (const auto& image : stored<CObservationImage>()) {
      all.push_back(mrpt::Clock::toDouble(image->timestamp));
    }
    return all;
  }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& image : stored<CObservationImage>()) {
      all.push_back(fs::path(image->image.getExternalStorageFile()).filename().string());
    }
    return all;
  }
  void expect_times(const std::vector<double>& expected) const {
    const auto found = times();
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-6) << i;
  }
  static bool notes(const ImportReport& report, const std::string& words) {
    for (const std::string& note : report.notes) {
      if (note.find(words) != std::string::npos) return true;
    }
    return false;
  }

  TemporaryFolder folder_;
  VideoImport options_;
};

using ImportImages = ImportDrive;

TEST_F(ImportImages, TakesThemInTheOrderOfTheirNumbersAtTheGivenRate) {
  make_images({"frame 10.png", "frame 2.jpg", "frame 1.png"});
  options_.fps = 20.0;
  const ImportReport report = import_image_folder(options_);
  EXPECT_EQ(names(), (std::vector<std::string>{"frame 1.png", "frame 2.jpg", "frame 10.png"}));
  EXPECT_TRUE(notes(report, "frame 1.png to frame 10.png"));
  expect_times({1317016800.0, 1317016800.05, 1317016800.1});
}

TEST_F(ImportImages, DecimalsOfSecondsAreNoCounter) {
  make_images({"t1311868164.5.png", "t1311868164.25.png", "t1311868164.025.png"});
  import_image_folder(options_);
  EXPECT_EQ(names(), (std::vector<std::string>{"t1311868164.025.png", "t1311868164.25.png",
                                               "t1311868164.5.png"}));
  expect_times({1311868164.025, 1311868164.25, 1311868164.5});
}

TEST_F(ImportImages, StoresCalibrationAndMounting) {
  make_images({"a1.png", "a2.png"});
  options_.fps = 10.0;
  options_.mount.pitch_up_deg = 5.0;
  import_image_folder(options_);
  const auto image = stored<CObservationImage>().at(1);
  EXPECT_EQ(image->cameraParams.ncols, 64U);
  EXPECT_EQ(image->cameraParams.fy(), 51.0);
  EXPECT_EQ(image->cameraParams.cx(), 32.0);
  EXPECT_NEAR(image->cameraPose.z(), 1.4, 1e-12);
  EXPECT_NEAR(image->cameraPose.getRotationMatrix()(2, 2), std::sin(5.0 * M_PI / 180), 1e-9);
  EXPECT_EQ(image->sensorLabel, "camera");
}

TEST_F(ImportImages, ScalesACalibrationOfTheSameAspectAndSaysSo) {
  make_images({"a1.png", "a2.png"});
  options_.fps = 10.0;
  write_text(options_.calibration, "1 PINHOLE 128 96 100 102 64.0 48.0\n");
  EXPECT_TRUE(notes(import_image_folder(options_), "is for 128x96, the images are 64x48"));
  EXPECT_EQ(stored<CObservationImage>().at(0)->cameraParams.fx(), 50.0);
  write_text(options_.calibration, "1 PINHOLE 128 72 100 102 64.0 48.0\n");
  EXPECT_NE(complaint_of([&] { import_image_folder(options_); }).find("is for 128x72"),
            std::string::npos);
}

/// A JPEG with the EXIF text of the given tags of its image directory, and how to turn it.
void write_exif(const fs::path& image, const std::map<int, std::string>& texts,
                std::size_t orientation = 1) {
  const auto number = [](std::size_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xff);
    return text;
  };
  // The orientation, and an entry that leads to the image's directory, which its texts follow.
  std::string tiff = "II*" + number(0, 1) + number(8, 4) + number(2, 2) + number(0x0112, 2) +
                     number(3, 2) + number(1, 4) + number(orientation, 4) + number(0x8769, 2) +
                     number(4, 2) + number(1, 4) + number(38, 4) + number(0, 4);
  std::string entries, behind;
  const std::size_t data = tiff.size() + 2 + 12 * texts.size() + 4;
  for (const auto& [tag, text] : texts) {
    const std::string with_end = text + number(0, 1);
    entries += number(static_cast<std::size_t>(tag), 2) + number(2, 2) + number(with_end.size(), 4);
    if (with_end.size() <= 4) {
      entries += with_end + std::string(4 - with_end.size(), char{0});
    } else {
      entries += number(data + behind.size(), 4);
      behind += with_end;
    }
  }
  tiff += number(texts.size(), 2) + entries + number(0, 4) + behind;
  const std::string content = "Exif" + number(0, 2) + tiff;
  const std::size_t length = content.size() + 2;
  std::string segment = {static_cast<char>(0xff), static_cast<char>(0xe1)};
  segment += static_cast<char>(length >> 8 & 0xff);
  segment += static_cast<char>(length & 0xff);
  test::write_image(image);
  std::ifstream in(image, std::ios::binary);
  std::string jpeg{std::istreambuf_iterator<char>(in), {}};
  in.close();
  std::ofstream(image, std::ios::binary) << jpeg.insert(2, segment + content);
}

constexpr int kTaken = 0x9003, kSubSecond = 0x9291, kZone = 0x9011;

TEST_F(ImportImages, StampsByTheirExifTimes) {
  for (int i = 0; i < 3; ++i) {
    write_exif(options_.source / ("DSC0" + std::to_string(i) + ".JPG"),
               {{kTaken, "2024:05:01 10:00:0" + std::to_string(i / 2)},
                {kSubSecond, i == 1 ? "5" : "25"}});
  }
  EXPECT_TRUE(notes(import_image_folder(options_), "EXIF times, whose time zone is not told"));
  expect_times({1714557600.25, 1714557600.5, 1714557601.25});
}

TEST_F(ImportImages, KnowsTheZoneThatExifTells) {
  for (int i = 0; i < 2; ++i) {
    write_exif(options_.source / ("p" + std::to_string(i) + ".jpg"),
               {{kTaken, "2024:05:01 12:00:0" + std::to_string(i)}, {kZone, "+02:00"}});
  }
  EXPECT_FALSE(notes(import_image_folder(options_), "time zone"));
  expect_times({1714557600.0, 1714557601.0});
}

TEST_F(ImportImages, WhoseZoneSomeTellAreAllInIt) {
  for (int i = 0; i < 4; ++i) {
    std::map<int, std::string> tags{{kTaken, "2024:05:01 12:00:0" + std::to_string(i)}};
    if (i == 1 || i == 2) tags[kZone] = "+02:00";
    write_exif(options_.source / ("p" + std::to_string(i) + ".jpg"), tags);
  }
  EXPECT_TRUE(notes(import_image_folder(options_),
                    "2 of 4 tell no time zone: that of the others is taken"));
  expect_times({1714557600.0, 1714557601.0, 1714557602.0, 1714557603.0});
}

TEST_F(ImportImages, AfterARolledOverCounterFollowTheOthers) {
  const std::vector<std::string> in_time{"DSC9998.jpg", "DSC9999.jpg", "DSC0000.jpg",
                                         "DSC0001.jpg"};
  for (std::size_t i = 0; i < in_time.size(); ++i) {
    write_exif(options_.source / in_time[i], {{kTaken, "2024:05:01 10:00:0" + std::to_string(i)}});
  }
  EXPECT_TRUE(notes(import_image_folder(options_),
                    "counter has begun anew: by their EXIF times the images go from DSC9998.jpg"));
  EXPECT_EQ(names(), in_time);
  expect_times({1714557600.0, 1714557601.0, 1714557602.0, 1714557603.0});
  options_.fps = 10.0;
  import_image_folder(options_);
  EXPECT_EQ(names(), in_time);
}

TEST_F(ImportImages, WhoseClockWasSetBackStayInTheOrderOfTheirNames) {
  for (int i = 0; i < 4; ++i) {  // as where the counter has begun anew, but for the names
    write_exif(options_.source / ("DSC000" + std::to_string(i) + ".jpg"),
               {{kTaken, "2024:05:01 10:00:0" + std::to_string((i + 2) % 4)}});
  }
  const std::string said = complaint_of([&] { import_image_folder(options_); });
  EXPECT_NE(said.find("EXIF time of DSC0002.jpg that is not later"), std::string::npos) << said;
  options_.fps = 10.0;
  import_image_folder(options_);
  EXPECT_EQ(names().front(), "DSC0000.jpg");
}

TEST_F(ImportImages, ThatExifSaysToTurnAreNoted) {
  make_images({"a1.jpg"});
  write_exif(options_.source / "a2.jpg", {{kTaken, "2024:05:01 10:00:00"}}, 6);
  write_exif(options_.source / "a3.jpg", {{kTaken, "2024:05:01 10:00:00"}}, 1);
  options_.fps = 10.0;
  EXPECT_TRUE(notes(import_image_folder(options_), "1 of 3 images tell an EXIF Orientation (6)"));
  fs::remove(options_.source / "a2.jpg");
  EXPECT_FALSE(notes(import_image_folder(options_), "Orientation"));
}

TEST_F(ImportImages, RefusesExifTimesOfWholeSecondsThatImagesShare) {
  for (int i = 0; i < 2; ++i) {
    write_exif(options_.source / ("p" + std::to_string(i) + ".jpg"),
               {{kTaken, "2024:05:01 12:00:00"}});
  }
  const std::string shared = complaint_of([&] { import_image_folder(options_); });
  EXPECT_NE(shared.find("a whole second only as EXIF time of p1.jpg"), std::string::npos) << shared;
  write_exif(options_.source / "p1.jpg", {{kTaken, "0000:00:00 00:00:00"}});
  const std::string none = complaint_of([&] { import_image_folder(options_); });
  EXPECT_NE(none.find("no EXIF time of p1.jpg"), std::string::npos) << none;
  EXPECT_NE(none.find("--fps"), std::string::npos) << none;
}

TEST_F(ImportImages, TakesTiffAndWebp) {
  options_.fps = 10.0;
  make_images({"1.tif", "2.tiff", "3.webp"});
  EXPECT_EQ(import_image_folder(options_).images, 3U);
}

TEST_F(ImportImages, StampsByTheTimesInTheirNames) {
  const std::vector<std::vector<std::string>> kinds{
      {"1403636579.763555.png", "1403636579.813555.png"},
      {"img_1403636579763.png", "img_1403636579813.png"},
      {"1403636579763555.png", "1403636579813555.png"},
      {"1403636579763555584.png", "1403636579813555456.png"}};
  for (const auto& kind : kinds) {
    fs::remove_all(options_.source);
    make_images(kind);
    EXPECT_TRUE(notes(import_image_folder(options_), "times in their names")) << kind[0];
    const auto found = times();
    EXPECT_NEAR(found.at(0), 1403636579.7635, 6e-4) << kind[0];
    EXPECT_NEAR(found.at(1) - found.at(0), 0.05, 1e-6) << kind[0];
  }
}

TEST_F(ImportImages, StampsByATableBesideThem) {
  make_images({"first.png", "second.png"});
  write_text(options_.source / "times.txt", "1403636579763\n1403636579813\n");
  EXPECT_TRUE(notes(import_image_folder(options_), "milliseconds"));
  expect_times({1403636579.763, 1403636579.813});
}

TEST_F(ImportImages, RefusesWhatHasNoTimesCalibrationOrImages) {
  const auto said = [&] { return complaint_of([&] { import_image_folder(options_); }); };
  EXPECT_NE(said().find("no images in it"), std::string::npos) << said();
  make_images({"a1.png", "a2.png"});
  EXPECT_NE(said().find("give their rate with --fps"), std::string::npos) << said();
  for (const double fps : {0.0, -1.0, 1e9, std::nan("")}) {
    options_.fps = fps;
    EXPECT_NE(said().find("--fps"), std::string::npos) << said();
  }
  options_.fps = 10.0;
  options_.camera_height_m = 165;
  EXPECT_NE(said().find("--camera-height 165"), std::string::npos) << said();
  options_.calibration.clear();
  EXPECT_NE(said().find("give it with --calibration"), std::string::npos) << said();
  EXPECT_FALSE(fs::exists(options_.log));
}

TEST_F(ImportImages, RefusesTwoCamerasInOneFolder) {
  make_images({"img_1_left.png", "img_1_Right.png"});
  options_.fps = 10.0;
  EXPECT_NE(complaint_of([&] { import_image_folder(options_); }).find("two cameras"),
            std::string::npos);
}

class ImportEuroc : public ImportDrive {
 protected:
  void make_sequence() {
    const fs::path cam = options_.source / "mav0" / "cam0";
    write_text_in(cam / "data.csv",
                  "#timestamp [ns],filename\r\n1403636579763555584,1403636579763555584.png\r\n"
                  "1403636579813555456,1403636579813555456.png\r\n"
                  "1403636579863555584,1403636579863555584.png\r\n");
    for (const char* name : {"1403636579763555584.png", "1403636579863555584.png"}) {
      test::write_image(cam / "data" / name);
    }
    write_text(cam / "sensor.yaml",
               "sensor_type: camera\ncamera_model: pinhole\nresolution: [64, 48]\n"
               "intrinsics: [50, 51, 32, 24]\ndistortion_model: radial-tangential\n"
               "distortion_coefficients: [-0.28, 0.07, 0.0002, -0.0003]\n");
    options_.calibration.clear();
  }
  static void write_text_in(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    write_text(file, text);
  }
};

TEST_F(ImportEuroc, ReadsListImagesAndSensor) {
  make_sequence();
  const ImportReport report = import_euroc(options_);
  expect_times({1403636579.763555584, 1403636579.863555584});
  EXPECT_TRUE(notes(report, "1 of 3 images of data.csv are not there"));
  const auto image = stored<CObservationImage>().at(0);
  EXPECT_EQ(image->sensorLabel, "cam0");
  EXPECT_EQ(image->cameraParams.dist[0], -0.28);
  options_.source /= "mav0";
  EXPECT_EQ(import_euroc(options_).images, 2U);
}

TEST_F(ImportEuroc, ReadsNamesAndHeadingsAsProgramsWriteThem) {
  make_sequence();
  const fs::path cam = options_.source / "mav0" / "cam0";
  for (const char* name : {"img 0.png", "img#1.png"}) test::write_image(cam / "data" / name);
  for (const char* list : {"1403636579763555584,img 0.png\n1403636579863555584,img#1.png\n",
                           "\xEF\xBB\xBF#timestamp [ns],filename\n1403636579763555584,img 0.png\n"
                           "1403636579863555584,img#1.png\n",
                           "\"timestamp\",\"filename\"\r\n\"1403636579763555584\",\"img 0.png\"\r\n"
                           "\"1403636579863555584\", \"img#1.png\"\r\n"}) {
    write_text(cam / "data.csv", list);
    EXPECT_EQ(import_euroc(options_).images, 2U) << list;
    expect_times({1403636579.763555584, 1403636579.863555584});
  }
}

TEST_F(ImportEuroc, NamesTheLineThatIsWrong) {
  make_sequence();
  const fs::path list = options_.source / "mav0" / "cam0" / "data.csv";
  const auto said = [&] { return complaint_of([&] { import_euroc(options_); }); };
  write_text(list, "#timestamp\n1403636579763555584,a.png\nsoon,b.png\n");
  EXPECT_NE(said().find("data.csv: line 3: is no time since 1970"), std::string::npos) << said();
  write_text(list, "1403636579763555584,a.png\n1403636579763555584,b.png\n");
  EXPECT_NE(said().find("data.csv: line 2: time does not increase"), std::string::npos) << said();
  write_text(list, "1403636579763555584,a.png\n");
  EXPECT_NE(said().find("none of its images is there"), std::string::npos) << said();
  fs::remove(list);
  EXPECT_NE(said().find("data.csv: no such file"), std::string::npos) << said();
}

using ImportTum = ImportDrive;

TEST_F(ImportTum, ReadsItsList) {
  make_images({"rgb/1305031452.791720.png", "rgb/1305031452.823674.png"});
  write_text(options_.source / "rgb.txt",
             "# color images\n# file: 'rgbd_dataset.bag'\n# timestamp filename\n"
             "1305031452.791720 rgb/1305031452.791720.png\n"
             "1305031452.823674 rgb/1305031452.823674.png\n");
  EXPECT_EQ(import_tum(options_).observations, 2U);
  expect_times({1305031452.791720, 1305031452.823674});
  EXPECT_EQ(stored<CObservationImage>().at(0)->sensorLabel, "rgb");
  options_.calibration.clear();
  EXPECT_NE(complaint_of([&] { import_tum(options_); }).find("--calibration"), std::string::npos);
}

TEST_F(ImportTum, ReadsNamesWithBlanksAndAHeading) {
  make_images({"rgb/img 0.png", "rgb/1.png"});
  write_text(options_.source / "rgb.txt",
             "timestamp filename\n1305031452.79 rgb/img 0.png\n"
             "1305031452.82 rgb/1.png depth/1.png # a pair\n");
  EXPECT_EQ(import_tum(options_).images, 2U);
  expect_times({1305031452.79, 1305031452.82});
}

class ImportKittiRaw : public ImportDrive {
 protected:
  void make_drive() {
    options_.source = folder_.path() / "2011_09_26" / "2011_09_26_drive_0001_sync";
    options_.calibration.clear();
    for (const char* name : {"0000000000.png", "0000000001.png"}) {
      test::write_image(options_.source / "image_00" / "data" / name);
      test::write_image(options_.source / "image_01" / "data" / name);
    }
    fs::remove(options_.source / "image_01" / "data" / "0000000001.png");
    fs::create_directories(options_.source / "oxts" / "data");
    const std::string stamps = "2011-09-26 13:02:25.964389445\n2011-09-26 13:02:26.074389445\n";
    write_text(options_.source / "image_00" / "timestamps.txt", stamps);
    write_text(options_.source / "oxts" / "timestamps.txt", stamps);
    write_text(options_.source / "oxts" / "data" / "0000000001.txt",
               "49.015 8.434 116.4 0.035 0.0089 -2.617 3 4 5 0.01 0 0.1 0.2 9.8 0 0 9.8 0.01 0.02 "
               "0.03 0 0 0 0.1 0.1 4 11 6 6 6\n");
    write_text(folder_.path() / "2011_09_26" / "calib_cam_to_cam.txt",
               "calib_time: 09-Jan-2012 13:57:47\nS_00: 80 60\nK_00: 55 0 40 0 55 30 0 0 1\n"
               "D_00: -0.3 0.2 0.002 0.001 -0.07\nS_rect_00: 64 48\n"
               "P_rect_00: 50 0 32 0 0 50 24 0 0 0 1 0\nS_rect_01: 64 48\n"
               "P_rect_01: 50 0 32 -27 0 50 24 0 0 0 1 0\n");
  }
};

TEST_F(ImportKittiRaw, ReadsPairsTimesAndOxts) {
  make_drive();
  const ImportReport report = import_kitti_raw(options_);
  EXPECT_EQ(report.images, 3U);
  const auto pairs = stored<CObservationStereoImages>();
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_NEAR(mrpt::Clock::toDouble(pairs[0]->timestamp), 1317042145.964389, 1e-5);
  EXPECT_NEAR(pairs[0]->rightCameraPose.x(), 0.54, 1e-9);
  EXPECT_EQ(pairs[0]->leftCamera.fx(), 50.0);
  EXPECT_TRUE(pairs[0]->hasImageRight);
  EXPECT_FALSE(pairs[1]->hasImageRight);
  const auto imu = stored<CObservationIMU>();
  ASSERT_EQ(imu.size(), 1U);
  EXPECT_NEAR(imu[0]->get(mrpt::obs::IMU_Z_ACC), 9.8, 1e-12);
  EXPECT_NEAR(imu[0]->get(mrpt::obs::IMU_WZ), 0.03, 1e-12);
  EXPECT_EQ(report.gps, 1U);
  const auto gps = stored<CObservationGPS>();
  EXPECT_EQ(gps.size(), 2U);  // position, then speed and course
  EXPECT_TRUE(notes(report, "1 right images of 2, 0.540 m beside"));
  EXPECT_TRUE(notes(report, "1 of 2 packets of oxts are not there"));
}

TEST_F(ImportKittiRaw, TakesTheRawCameraForImagesOfItsSize) {
  make_drive();
  for (const char* name : {"0000000000.png", "0000000001.png"}) {
    test::write_image(options_.source / "image_00" / "data" / name, 80, 60);
  }
  import_kitti_raw(options_);
  const auto images = stored<CObservationImage>();
  ASSERT_EQ(images.size(), 2U);
  EXPECT_EQ(images[0]->cameraParams.fx(), 55.0);
  EXPECT_EQ(images[0]->cameraParams.dist[0], -0.3);
}

TEST_F(ImportKittiRaw, TakesTheRectifiedCameraWhereBothAreOfTheImagesSizeOrNoRawOneIsThere) {
  make_drive();
  const std::string rectified =
      "S_rect_00: 64 48\nP_rect_00: 50 0 32 0 0 50 24 0 0 0 1 0\n"
      "S_rect_01: 64 48\nP_rect_01: 50 0 32 -27 0 50 24 0 0 0 1 0\n";
  for (const char* raw : {"S_00: 64 48\nK_00: 55 0 40 0 55 30 0 0 1\nD_00: -0.3 0.2 0 0 0\n", ""}) {
    write_text(folder_.path() / "2011_09_26" / "calib_cam_to_cam.txt", raw + rectified);
    import_kitti_raw(options_);
    const auto pairs = stored<CObservationStereoImages>();
    ASSERT_FALSE(pairs.empty()) << raw;
    EXPECT_EQ(pairs[0]->leftCamera.fx(), 50.0) << raw;
  }
}

TEST_F(ImportKittiRaw, TakesItsHeightAndNamesTheLineThatIsWrong) {
  make_drive();
  options_.camera_height_m.reset();
  EXPECT_TRUE(notes(import_kitti_raw(options_), "1.65 m"));
  const auto said = [&] { return complaint_of([&] { import_kitti_raw(options_); }); };
  write_text(options_.source / "oxts" / "data" / "0000000001.txt", "1 2 3\n");
  EXPECT_NE(said().find("0000000001.txt: line 1"), std::string::npos) << said();
  for (const char* no_day : {"2011-02-29", "2011-04-31", "1900-02-29", "2011-09-00"}) {
    write_text(options_.source / "image_00" / "timestamps.txt",
               std::string(no_day) + " 13:02:25.9\n2012-02-29 13:02:25\n");
    EXPECT_NE(said().find("timestamps.txt: line 1"), std::string::npos) << no_day << said();
  }
  write_text(options_.source / "image_00" / "timestamps.txt",
             "2012-02-29 23:59:59\n2012-03-01 00:00:00\n");
  write_text(options_.source / "oxts" / "timestamps.txt", "");
  import_kitti_raw(options_);
  const auto pairs = stored<CObservationStereoImages>();
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_NEAR(mrpt::Clock::toDouble(pairs[0]->timestamp), 1330559999.0, 1e-6);
  EXPECT_NEAR(mrpt::Clock::toDouble(pairs[1]->timestamp), 1330560000.0, 1e-6);
  write_text(options_.source / "image_00" / "timestamps.txt", "2011-09-26 13:02:25.9\nlater\n");
  EXPECT_NE(said().find("timestamps.txt: line 2"), std::string::npos) << said();
  fs::remove(folder_.path() / "2011_09_26" / "calib_cam_to_cam.txt");
  EXPECT_NE(said().find("calib_cam_to_cam.txt: no such file"), std::string::npos) << said();
}

class ImportKittiStereo : public ImportDrive {
 protected:
  void make_sequence(const std::string& P1) {
    for (const char* name : {"000000.png", "000001.png"}) {
      test::write_image(options_.source / "image_0" / name);
      test::write_image(options_.source / "image_1" / name);
    }
    write_text(options_.source / "calib.txt", "P0: 50 0 32 0 0 50 24 0 0 0 1 0\n" + P1);
    kitti_.source = options_.source;
    kitti_.log = options_.log;
    kitti_.camera_height_m = 1.65;
  }
  KittiImport kitti_;
};

TEST_F(ImportKittiStereo, TakesTheBaselineBetweenTheProjections) {
  make_sequence("P1: 50 0 32 -26.85 0 50 24 0 0 0 1 0\n");
  kitti_.copy_images = true;
  const ImportReport report = import_kitti(kitti_);
  EXPECT_EQ(report.images, 4U);
  const auto pairs = stored<CObservationStereoImages>();
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_NEAR(pairs[1]->rightCameraPose.x(), 0.537, 1e-9);
  EXPECT_EQ(pairs[1]->imageRight.getExternalStorageFile(), "right_000001.png");
  EXPECT_EQ(test::names_in(folder_.path() / "out" / "drive_Images").size(), 4U);
}

TEST_F(ImportKittiStereo, StampsAtTheGivenRate) {
  make_sequence("");
  kitti_.fps = 20.0;
  import_kitti(kitti_);
  EXPECT_NEAR(times().at(1) - times().at(0), 0.05, 1e-6);
}

TEST_F(ImportKittiStereo, LeavesRightImagesOutWhereNoBaselineIs) {
  make_sequence("P1: 50 0 32 -26850 0 50 24 0 0 0 1 0\n");  // mm
  EXPECT_TRUE(notes(import_kitti(kitti_), "P1 is 537 m to the right of P0"));
  EXPECT_EQ(stored<CObservationImage>().size(), 2U);
  make_sequence("");
  EXPECT_TRUE(notes(import_kitti(kitti_), "calib.txt has no P1"));
  EXPECT_EQ(stored<CObservationImage>().size(), 2U);
}

TEST_F(ImportKittiStereo, LeavesOutRightImagesOfAnotherCamera) {
  for (const auto& [P1, fault] :
       std::map<std::string, std::string>{{"60 0 32 -32 0 50 24 0 0 0 1 0", "fx 60, not 50"},
                                          {"50 0 32 -27 0 60 24 0 0 0 1 0", "fy 60, not 50"},
                                          {"50 0 30 -27 0 50 24 0 0 0 1 0", "cx 30, not 32"},
                                          {"50 0 32 -27 0 50 20 0 0 0 1 0", "cy 20, not 24"}}) {
    make_sequence("P1: " + P1 + "\n");
    EXPECT_TRUE(
        notes(import_kitti(kitti_), "P1 is no camera of a rectified pair with P0: " + fault));
    EXPECT_EQ(stored<CObservationImage>().size(), 2U);
  }
}

TEST_F(ImportKittiStereo, TakesTheProjectionsOfTheGivenCalibration) {
  make_sequence("");
  const fs::path given = folder_.path() / "given.txt";
  const std::string P0 = "P0: 50 0 32 0 0 50 24 0 0 0 1 0\n";
  write_text(given, P0 + "P1: 50 0 32 -27 0 50 24 0 0 0 1 0\nP2: 50 0 32 3 0 50 24 0 0 0 1 0\n");
  for (const char* section : {"", ":P0"}) {
    kitti_.calibration = given.string() + section;
    EXPECT_EQ(import_kitti(kitti_).images, 4U) << section;
    EXPECT_NEAR(stored<CObservationStereoImages>().at(0)->rightCameraPose.x(), 0.54, 1e-9);
  }
  kitti_.calibration = given.string() + ":P2";
  EXPECT_TRUE(notes(import_kitti(kitti_), "image_1 is left out: the calibration is P2"));
  kitti_.calibration = options_.calibration;
  EXPECT_TRUE(notes(import_kitti(kitti_), "image_1 is left out: cameras.txt has no P1"));
  EXPECT_EQ(stored<CObservationImage>().size(), 2U);
}

class ImportVideo : public ImportDrive {
 protected:
  /// Lossless, with a grey of its own in each frame.
  void make_video(int frames = 6) {
    options_.source = folder_.path() / "drive.mkv";
    cv::VideoWriter writer(options_.source.string(), cv::CAP_FFMPEG,
                           cv::VideoWriter::fourcc('F', 'F', 'V', '1'), 12.5, cv::Size(64, 48));
    ASSERT_TRUE(writer.isOpened());
    for (int i = 0; i < frames; ++i)
      writer.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(20 * i)));
  }
};

TEST_F(ImportVideo, DecodesItsFramesAtTheirTimes) {
  make_video();
  const ImportReport report = import_video(options_);
  EXPECT_EQ(report.images, 6U);
  expect_times(
      {1317016800.0, 1317016800.08, 1317016800.16, 1317016800.24, 1317016800.32, 1317016800.4});
  const auto image = stored<CObservationImage>().at(3);
  const cv::Mat pixels = cv::imread(image->image.getExternalStorageFile(), cv::IMREAD_GRAYSCALE);
  ASSERT_FALSE(pixels.empty());
  EXPECT_NEAR(pixels.at<std::uint8_t>(20, 30), 60, 1);
}

TEST_F(ImportVideo, TakesAPartOrAnotherRate) {
  make_video();
  options_.from_s = 0.1;
  options_.to_s = 0.3;
  import_video(options_);
  EXPECT_EQ(names(), (std::vector<std::string>{"000002.png", "000003.png"}));
  options_.from_s = 0.0;
  options_.to_s.reset();
  options_.fps = 5.0;
  import_video(options_);
  EXPECT_NEAR(times().at(5), 1317016801.0, 1e-6);
}

/// Three fixes a second apart; the video begins with the second one.
class ImportVideoGps : public ImportVideo {
 protected:
  ImportReport import_with(const std::string& start = "1714557601") {
    make_video(20);
    options_.start = start;
    return import_video(options_);
  }
  void expect_fixes(const ImportReport& report, bool moving) const {
    EXPECT_EQ(report.gps, 3U);
    const auto observations = stored<CObservationGPS>();
    ASSERT_EQ(observations.size(), moving ? 6U : 3U);
    EXPECT_NEAR(mrpt::Clock::toDouble(observations[0]->timestamp), 1714557600.0, 1e-6);
    const auto& gga = observations[0]->getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>();
    EXPECT_NEAR(test::copied(gga.fields.latitude_degrees), 48.1173, 1e-6);
    EXPECT_NEAR(test::copied(gga.fields.longitude_degrees), -11.516667, 1e-6);
    EXPECT_NEAR(test::copied(gga.fields.altitude_meters), 545.4, 1e-6);
  }
};

TEST_F(ImportVideoGps, OfNmea) {
  options_.nmea = folder_.path() / "drive.nmea";
  write_text(options_.nmea,
             "$GPGGA,100000.00,4807.038,N,01131.0000,W,2,08,0.9,545.4,M,46.9,M,,*44\r\n"
             "$GPRMC,100000.00,A,4807.038,N,01131.0000,W,022.4,084.4,010524,,,A\r\n"
             "$GPRMC,100001.00,A,4807.039,N,01131.0000,W,022.4,084.4,010524,,,A\r\n"
             "$GPRMC,100001.50,V,,,,,,,010524,,,N\r\n"
             "$GPRMC,100002.00,A,4807.040,N,01131.0000,W,022.4,084.4,010524,,,A\r\n"
             "$GPRMC,100003.00,A,4807.041,N,01131.0000,W,022.4,084.4,010524,,,A*00\r\n");
  const ImportReport report = import_with();
  expect_fixes(report, true);
  EXPECT_TRUE(notes(report, "2 fixes of drive.nmea are void, damaged"));
  // RMC have no height, and the last two no GGA of their own.
  for (const auto& observation : stored<CObservationGPS>()) {
    if (!observation->hasMsgClass<mrpt::obs::gnss::Message_NMEA_GGA>()) continue;
    const auto& gga = observation->getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>();
    EXPECT_NEAR(test::copied(gga.fields.altitude_meters), 545.4, 1e-6);
  }
  std::ifstream lines(options_.nmea);
  std::string text(std::istreambuf_iterator<char>(lines), {});
  text.erase(std::remove(text.begin(), text.end(), '\n'), text.end());  // as the Macs of old
  write_text(options_.nmea, text);
  EXPECT_EQ(import_with().gps, 3U);
  write_text(options_.nmea, "$GPGGA,100000.00,4807.038,N,01131.0,W,1,08,0.9,545.4,M,46.9,M,,\n");
  EXPECT_NE(complaint_of([&] { import_video(options_); }).find("no RMC sentences"),
            std::string::npos);
}

TEST_F(ImportVideoGps, OfGpx) {
  options_.gpx = folder_.path() / "drive.gpx";
  const auto point = [](const std::string& latitude, const std::string& second) {
    return "<trkpt lat=\"" + latitude +
           "\" lon=\"-11.516667\">\n<ele>545.4</ele>\n<time>2024-05-01T"
           "10:00:0" +
           second + "Z</time></trkpt>\n";
  };
  const std::string head = "<?xml version=\"1.0\"?>\n<gpx version=\"1.1\"><trk><trkseg>\n";
  write_text(options_.gpx, head + point("48.1173", "0") + point("48.1174", "1.000") +
                               point("48.1174", "1") + point("48.1175", "2") +
                               "</trkseg></trk></gpx>\n");
  const ImportReport report = import_with("2024-05-01T10:00:01Z");
  expect_fixes(report, false);
  EXPECT_TRUE(notes(report, "1 points of drive.gpx"));
  EXPECT_FALSE(notes(report, "zone"));
  // Backwards, and in the time of Berlin.
  std::string turned = head + point("48.1175", "2") + point("48.1174", "1") +
                       point("48.1173", "0") + "</trkseg></trk></gpx>\n";
  for (auto at = turned.find("T10:"); at != std::string::npos; at = turned.find("T10:", at)) {
    turned.replace(at, 4, "T12:");
    turned.replace(turned.find('Z', at), 1, "+02:00");
  }
  write_text(options_.gpx, turned);
  expect_fixes(import_with("2024-05-01T06:30:01-0330"), false);
  turned.replace(turned.find("+02:00"), 6, "");
  write_text(options_.gpx, turned);
  EXPECT_TRUE(notes(import_with("2024-05-01T10:00:01Z"), "1 times of drive.gpx name no zone"));
  const auto said = [&] { return complaint_of([&] { import_video(options_); }); };
  write_text(options_.gpx, head + point("north", "0") + "</trkseg></trk></gpx>\n");
  EXPECT_NE(said().find("drive.gpx: line 3: trkpt has no lat"), std::string::npos) << said();
  write_text(options_.gpx, head + "</gpx>");
  EXPECT_NE(said().find("line 3: it is no XML"), std::string::npos) << said();
}

TEST_F(ImportVideoGps, OfATable) {
  options_.csv = folder_.path() / "drive.csv";
  write_text(options_.csv,
             "time,lat,lon,ele,speed_kmh,course\n1714557600000,48.1173,-11.516667,545.4,41.5,84\n"
             "1714557601000,48.1174,-11.516667,545.4,41.5,84\n"
             "1714557602000,48.1175,-11.516667,545.4,41.5,84\n1714557700000,48.2,-11.5,545,0,0\n");
  expect_fixes(import_with(), true);
  std::ifstream counted(options_.csv);
  std::string dated(std::istreambuf_iterator<char>(counted), {});
  for (const char* second : {"0", "1", "2"}) {
    const std::string number = "171455760" + std::string(second) + "000";
    dated.replace(dated.find(number), number.size(), "2024-05-01 10:00:0" + std::string(second));
  }
  write_text(options_.csv, dated);
  const ImportReport of_dates = import_with();
  expect_fixes(of_dates, true);
  EXPECT_TRUE(notes(of_dates, "3 times of drive.csv name no zone"));
  // Where a receiver is before its first fix.
  std::ifstream stream(options_.csv);
  const std::string table(std::istreambuf_iterator<char>(stream), {});
  write_text(options_.csv, table + "1714557599000,0,0,0,0,0\n");
  const ImportReport report = import_with();
  expect_fixes(report, true);
  EXPECT_TRUE(notes(report, "1 fixes of drive.csv are void, damaged, at 0, 0"));
  const auto rmc = stored<CObservationGPS>().at(1);
  const auto& fields = rmc->getMsgByClass<mrpt::obs::gnss::Message_NMEA_RMC>().fields;
  EXPECT_NEAR(test::copied(fields.speed_knots), 41.5 / 1.852, 1e-9);
  const auto said = [&] { return complaint_of([&] { import_video(options_); }); };
  write_text(options_.csv, "time,lat,lon,speed\n1714557600,48.1,-11.5,3\n1714557601,48.2,x,3\n");
  EXPECT_NE(said().find("drive.csv: line 3: longitude 'x'"), std::string::npos) << said();
  write_text(options_.csv, "time,lat,lon,speed\n1714557600,48.1,-11.5,3\n");
  EXPECT_TRUE(notes(import_video(options_), "their unit is not known"));
  write_text(options_.csv, "a,b,c\n");
  EXPECT_NE(said().find("names no columns time, lat and lon"), std::string::npos) << said();
}

TEST_F(ImportVideoGps, SaysWhatItTakesForTheStartAndWhatDoesNotOverlap) {
  options_.csv = folder_.path() / "drive.csv";
  write_text(options_.csv, "time,lat,lon\n1714557600,48.1,-11.5\n1714557601,48.2,-11.5\n");
  EXPECT_TRUE(notes(import_with(""), "the video is taken to begin with the first fix"));
  EXPECT_NEAR(times().front(), 1714557600.0, 1e-6);
  EXPECT_TRUE(notes(import_with("1714550000"), "no fix lies within the video"));
  EXPECT_NE(complaint_of([&] { import_with("noon"); }).find("--start noon"), std::string::npos);
  options_.gpx = options_.csv;
  EXPECT_NE(complaint_of([&] { import_with(); }).find("several are given"), std::string::npos);
}

TEST_F(ImportVideo, RefusesWhatIsNoVideoOrNoPart) {
  const auto said = [&] { return complaint_of([&] { import_video(options_); }); };
  options_.source = folder_.path() / "none.mp4";
  EXPECT_NE(said().find("no such file"), std::string::npos) << said();
  write_text(options_.source, "this is no video");
  ::testing::internal::CaptureStderr();
  EXPECT_NE(said().find("it is no video"), std::string::npos) << said();
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");  // FFmpeg keeps its words to itself
  make_video();
  options_.from_s = 5.0;
  EXPECT_NE(said().find("0 frames between"), std::string::npos) << said();
  options_.to_s = 1.0;
  EXPECT_NE(said().find("--from 5 --to 1"), std::string::npos) << said();
  options_.calibration.clear();
  options_.to_s.reset();
  EXPECT_NE(said().find("--calibration"), std::string::npos) << said();
}

}  // namespace
}  // namespace oneac
