// One drive in the layouts and calibration files of others gives the same poses.
#include "drive_fixture.h"

#include "oneac/evaluation/trajectory_io.h"
#include "oneac/rawlog/rawlog_source.h"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include <algorithm>
#include <string>
#include <utility>

namespace oneac {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> left_images(const fs::path& drive) {
  std::vector<fs::path> images;
  for (const auto& entry : fs::directory_iterator(drive / "Images")) {
    const bool right = entry.path().filename().string().find("_right") != std::string::npos;
    if (!right) images.push_back(entry.path());
  }
  std::sort(images.begin(), images.end());
  return images;
}

class DataIn : public DriveFixture {
 protected:
  [[nodiscard]] std::vector<Eigen::Isometry3d> poses_of(
      const std::string& rawlog, const std::vector<std::string>& extra = {}) const {
    std::vector<std::string> arguments{"run", rawlog, "-o", out()};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    const ProgramResult result = oneac_program(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return read_kitti(fs::path(out()) / "trajectory_camera.kitti").poses;
  }
  static void expect_same(const std::vector<Eigen::Isometry3d>& some,
                          const std::vector<Eigen::Isometry3d>& others, const std::string& what) {
    ASSERT_EQ(some.size(), others.size()) << what;
    for (std::size_t i = 0; i < some.size(); ++i) {
      EXPECT_TRUE(some[i].isApprox(others[i], 1e-6)) << what << ": frame " << i;
    }
  }
};

using CalibrationFiles = DataIn;

/// The same lens in everybody's words.
std::vector<std::pair<std::string, std::string>> files_of_a_lens() {
  const std::string K = "[250, 0, 159.5, 0, 250, 119.5, 0, 0, 1]";
  const std::string k = "[-0.05, 0.01, 0.001, -0.001]";
  return {
      {"ros.yaml",
       "image_width: 320\nimage_height: 240\ncamera_name: c\ncamera_matrix:\n  rows: 3\n"
       "  cols: 3\n  data: " +
           K +
           "\ndistortion_model: plumb_bob\ndistortion_coefficients:\n  rows: 1\n  cols: 4\n"
           "  data: " +
           k + "\n"},
      {"opencv.yml",
       "%YAML:1.0\n---\nimage_width: 320\nimage_height: 240\n"
       "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: " +
           K +
           "\ndistortion_coefficients: !!opencv-matrix\n   rows: 4\n   cols: 1\n   dt: d\n"
           "   data: " +
           k + "\n"},
      {"opencv.xml",
       "<?xml version=\"1.0\"?>\n<opencv_storage>\n<image_width>320</image_width>\n"
       "<image_height>240</image_height>\n<camera_matrix type_id=\"opencv-matrix\">\n"
       "  <rows>3</rows>\n  <cols>3</cols>\n  <dt>d</dt>\n"
       "  <data>250. 0. 159.5 0. 250. 119.5 0. 0. 1.</data></camera_matrix>\n"
       "<distortion_coefficients type_id=\"opencv-matrix\">\n  <rows>4</rows>\n"
       "  <cols>1</cols>\n  <dt>d</dt>\n  <data>-0.05 0.01 0.001 -0.001</data>"
       "</distortion_coefficients>\n</opencv_storage>\n"},
      {"kalibr.yaml", "cam0:\n  camera_model: pinhole\n  distortion_coeffs: " + k +
                          "\n  distortion_model: radtan\n  intrinsics: [250, 250, 159.5, 119.5]\n"
                          "  resolution: [320, 240]\n"},
      {"cameras.txt", "# cameras\n1 OPENCV 320 240 250 250 160 120 -0.05 0.01 0.001 -0.001\n"},
      {"orb.yaml",
       "%YAML:1.0\nCamera.fx: 250.0\nCamera.fy: 250.0\nCamera.cx: 159.5\nCamera.cy: 119.5\n"
       "Camera.k1: -0.05\nCamera.k2: 0.01\nCamera.p1: 0.001\nCamera.p2: -0.001\n"
       "Camera.width: 320\nCamera.height: 240\n"}};
}

TEST_F(CalibrationFiles, OfEachKindGiveTheSamePoses) {
  write_text(scratch() / "mrpt.ini",
             "\xEF\xBB\xBF[CAMERA]\nresolution = [320 240]\nfx = 250\nfy = 250\ncx = 159.5\n"
             "cy = 119.5\ndist = [-0.05 0.01 0.001 -0.001 0]\n");
  const auto expected = poses_of(log(), {"--calibration", (scratch() / "mrpt.ini").string()});
  const auto plain = poses_of(log());
  EXPECT_FALSE(plain.back().isApprox(expected.back(), 1e-6)) << "the test is blunt";
  for (const auto& [name, text] : files_of_a_lens()) {
    write_text(scratch() / name, text);
    expect_same(poses_of(log(), {"--calibration", (scratch() / name).string()}), expected, name);
  }
}

TEST_F(CalibrationFiles, OfKittisRawDataGiveThePosesOfItsRectifiedCamera) {
  write_text(scratch() / "calib_cam_to_cam.txt",
             "calib_time: 09-Jan-2012\nS_00: 640 480\nK_00: 500 0 320 0 500 240 0 0 1\n"
             "D_00: -0.3 0.1 0 0 0\nS_rect_00: 320 240\n"
             "P_rect_00: 250 0 159.5 0 0 250 119.5 0 0 0 1 0\n");
  expect_same(poses_of(log(), {"--calibration", (scratch() / "calib_cam_to_cam.txt").string()}),
              poses_of(log()), "KITTI raw");
}

TEST_F(CalibrationFiles, OfAnotherSizeAreScaledAndThatIsSaid) {
  write_text(scratch() / "cameras.txt", "1 PINHOLE 640 480 500 500 320 240\n");
  const std::vector<std::string> given{
      "run", log(), "-o", out(), "--calibration", (scratch() / "cameras.txt").string()};
  const ProgramResult result = oneac_program(given);
  EXPECT_NE(result.err.find("their calibration is for 640x480 and was scaled"), std::string::npos)
      << result.err;
  const auto scaled = read_kitti(fs::path(out()) / "trajectory_camera.kitti").poses;
  expect_same(poses_of(log()), scaled, "scaled");
  write_text(scratch() / "cameras.txt", "1 PINHOLE 640 360 500 500 320 180\n");
  const ProgramResult refused = oneac_program(given);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("is 320x240 but its calibration is for 640x360"), std::string::npos)
      << refused.err;
}

class Imports : public DataIn {
 protected:
  static constexpr const char* kStamps[kFrames] = {
      "1305031452.100000", "1305031452.200000", "1305031452.300000", "1305031452.400000",
      "1305031452.500000", "1305031452.600000", "1305031452.700000", "1305031452.800000"};

  void SetUp() override {
    images_ = left_images(drive());
    ASSERT_EQ(images_.size(), std::size_t{kFrames});
    write_text(calibration(), "1 PINHOLE 320 240 250 250 160 120\n");
    std::string times;
    for (std::size_t i = 0; i < images_.size(); ++i) {
      put(i, "kitti/image_0/00000" + std::to_string(i) + ".jpg");
      times += std::string(kStamps[i]) + "\n";
    }
    write_text(scratch() / "kitti" / "times.txt", times);
    write_text(scratch() / "kitti" / "calib.txt", "P0: 250 0 159.5 0 0 250 119.5 0 0 0 1 0\n");
    expected_ = poses_of(import("kitti", "kitti"));
  }
  [[nodiscard]] fs::path calibration() const { return scratch() / "cameras.txt"; }
  void put(std::size_t i, const std::string& name) const {
    fs::create_directories((scratch() / name).parent_path());
    fs::copy_file(images_[i], scratch() / name);
  }
  /// The log of `oneac import LAYOUT SOURCE`.
  [[nodiscard]] std::string import(const std::string& layout, const std::string& source,
                                   const std::vector<std::string>& extra = {}) const {
    const std::string rawlog = (scratch() / (layout + ".rawlog")).string();
    std::vector<std::string> arguments{
        "import", layout, (scratch() / source).string(), "-o", rawlog, "--camera-height", "1.5"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    const ProgramResult result = oneac_program(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return rawlog;
  }
  [[nodiscard]] std::vector<std::string> calibrated() const {
    return {"--calibration", calibration().string()};
  }
  static std::string nanoseconds(std::size_t i) {
    std::string digits = kStamps[i];
    digits.erase(digits.find('.'), 1);
    return digits + "000";
  }

  std::vector<fs::path> images_;
  std::vector<Eigen::Isometry3d> expected_;
};

TEST_F(Imports, OfImagesWithTimesInTheirNames) {
  for (std::size_t i = 0; i < images_.size(); ++i) put(i, "any/img_" + nanoseconds(i) + ".jpg");
  expect_same(poses_of(import("images", "any", calibrated())), expected_, "images");
}

TEST_F(Imports, OfImagesAtARate) {
  for (std::size_t i = 0; i < images_.size(); ++i) put(i, "any/" + std::to_string(i + 5) + ".jpg");
  std::vector<std::string> extra = calibrated();
  extra.insert(extra.end(), {"--fps", "10"});
  expect_same(poses_of(import("images", "any", extra)), expected_, "images at 10 Hz");
}

TEST_F(Imports, OfAnEurocSequence) {
  std::string list = "#timestamp [ns],filename\n";
  for (std::size_t i = 0; i < images_.size(); ++i) {
    const std::string name = nanoseconds(i) + ".jpg";
    put(i, "euroc/mav0/cam0/data/" + name);
    list += nanoseconds(i) + "," + name + "\n";
  }
  write_text(scratch() / "euroc/mav0/cam0/data.csv", list);
  write_text(scratch() / "euroc/mav0/cam0/sensor.yaml",
             "sensor_type: camera\nrate_hz: 10\nresolution: [320, 240]\ncamera_model: pinhole\n"
             "intrinsics: [250, 250, 159.5, 119.5]\ndistortion_model: radial-tangential\n"
             "distortion_coefficients: [0.0, 0.0, 0.0, 0.0]\n");
  expect_same(poses_of(import("euroc", "euroc")), expected_, "euroc");
}

TEST_F(Imports, OfATumSequence) {
  std::string list = "# color images\n# timestamp filename\n";
  for (std::size_t i = 0; i < images_.size(); ++i) {
    const std::string name = std::string("rgb/") + kStamps[i] + ".jpg";
    put(i, "tum/" + name);
    list += std::string(kStamps[i]) + " " + name + "\n";
  }
  write_text(scratch() / "tum/rgb.txt", list);
  expect_same(poses_of(import("tum", "tum", calibrated())), expected_, "tum");
}

TEST_F(Imports, OfADriveOfKittisRawData) {
  std::string stamps;
  for (std::size_t i = 0; i < images_.size(); ++i) {
    put(i, "day/drive/image_00/data/000000000" + std::to_string(i) + ".jpg");
    stamps += std::string("2011-05-10 12:44:12.") + std::to_string(i + 1) + "00000000\n";
  }
  write_text(scratch() / "day/drive/image_00/timestamps.txt", stamps);
  write_text(scratch() / "day/calib_cam_to_cam.txt",
             "S_00: 640 480\nK_00: 500 0 320 0 500 240 0 0 1\nD_00: -0.3 0.1 0 0 0\n"
             "S_rect_00: 320 240\nP_rect_00: 250 0 159.5 0 0 250 119.5 0 0 0 1 0\n");
  expect_same(poses_of(import("kitti", "day/drive")), expected_, "kitti raw");
}

TEST_F(Imports, OfAKittiSequenceWithRightImages) {
  for (std::size_t i = 0; i < images_.size(); ++i) {
    put(i, "kitti/image_1/00000" + std::to_string(i) + ".jpg");
  }
  write_text(
      scratch() / "kitti" / "calib.txt",
      "P0: 250 0 159.5 0 0 250 119.5 0 0 0 1 0\nP1: 250 0 159.5 -135 0 250 119.5 0 0 0 1 0\n");
  expect_same(poses_of(import("kitti", "kitti")), expected_, "left images of pairs");
}

TEST_F(Imports, OfAVideoGiveThePosesOfItsDecodedFrames) {
  {
    cv::VideoWriter writer((scratch() / "drive.mkv").string(), cv::CAP_FFMPEG,
                           cv::VideoWriter::fourcc('F', 'F', 'V', '1'), 10.0, cv::Size(320, 240));
    ASSERT_TRUE(writer.isOpened());
    for (const fs::path& image : images_) writer.write(cv::imread(image.string()));
  }
  const auto poses = poses_of(import("video", "drive.mkv", calibrated()));
  fs::remove_all(scratch() / "kitti" / "image_0");
  fs::copy(scratch() / "video_Images", scratch() / "kitti" / "image_0");
  fs::remove(scratch() / "kitti" / "times.txt");
  expect_same(poses, poses_of(import("kitti", "kitti")), "video");
}

std::vector<double> times_in(const fs::path& log) {
  SourceOptions options;
  options.log = log;
  RawlogSource source(options);
  std::vector<double> times;
  while (const auto ticket = source.next()) times.push_back(ticket->time_s);
  return times;
}

/// The usual video of a dashcam: the decoder holds the last frames back, and gives them no time.
TEST_F(Imports, OfAVideoWithFramesThatNeedLaterOnesKeepTheirTimes) {
  for (const std::string name : {"drive.mp4", "drive.avi"}) {
    {
      cv::VideoWriter writer((scratch() / name).string(), cv::CAP_FFMPEG,
                             cv::VideoWriter::fourcc('H', '2', '6', '4'), 10.0, cv::Size(320, 240));
      ASSERT_TRUE(writer.isOpened()) << "FFmpeg has no encoder of H.264";
      for (const fs::path& image : images_) writer.write(cv::imread(image.string()));
    }
    const std::vector<double> times = times_in(import("video", name, calibrated()));
    ASSERT_EQ(times.size(), images_.size()) << name;
    EXPECT_NEAR(times.front(), 1317016800.0, 1e-6) << name;  // as of images without times
    for (std::size_t i = 1; i < times.size(); ++i) {
      EXPECT_NEAR(times[i] - times[i - 1], 0.1, 1e-3) << name << ": frame " << i;
    }
  }
}

/// Whatever reads bags: these say so before.
TEST_F(Imports, OfABagOfAnotherKindSayWhatToDo) {
  const auto refusal = [&](const std::string& program, const fs::path& bag) {
    const ProgramResult result = run_program(
        {program, "import", "rosbag", bag.string(), "-o", (scratch() / "o.rawlog").string()});
    EXPECT_EQ(result.exit_code, 2) << result.out;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    return result.err;
  };
  fs::create_directories(scratch() / "ros2");
  write_text(scratch() / "ros2" / "metadata.yaml", "rosbag2_bagfile_information:\n");
  write_text(scratch() / "a.db3", "SQLite format 3");
  write_text(scratch() / "a.bag", "\x89MCAP0\r\n");
  for (const char* bag : {"ros2", "a.db3", "a.bag"}) {
    const std::string line = refusal(ONEAC_PROGRAM, scratch() / bag);
    EXPECT_NE(line.find("is a bag of ROS 2"), std::string::npos) << line;
    EXPECT_NE(line.find("rosbag2rawlog"), std::string::npos) << line;
  }
  write_text(scratch() / "old.bag", "#ROSRECORD V1.1\n");
  EXPECT_NE(refusal(ONEAC_PROGRAM, scratch() / "old.bag").find("before 2.0"), std::string::npos);
  write_text(scratch() / "text.bag", "no bag at all");
  EXPECT_NE(refusal(ONEAC_PROGRAM, scratch() / "text.bag").find("no bag of ROS"),
            std::string::npos);
  // A program without the one that reads bags beside it.
  write_text(scratch() / "drive.bag", "#ROSBAG V2.0\n");
  fs::copy_file(ONEAC_PROGRAM, scratch() / "oneac");
  const std::string line = refusal((scratch() / "oneac").string(), scratch() / "drive.bag");
  EXPECT_NE(line.find("install librosbag-storage-dev"), std::string::npos) << line;
}

}  // namespace
}  // namespace oneac
