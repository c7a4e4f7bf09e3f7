#include "oneac/evaluation/relative_poses_io.h"
#include "oneac/evaluation/trajectory_io.h"
#include "oneac/test_support/program.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

/// The first sixty frames of KITTI 03, as another camera, or another calibration, would have them:
/// right when the program is told, without metres and with the cure when it is not.
namespace oneac {
namespace {

namespace fs = std::filesystem;

constexpr int kImages = 60;
constexpr double kWay_m = 45.9;  // by the data set's poses
constexpr double kWidth = 1242.0, kHeight = 375.0;
constexpr double kFocal = 721.5377, kCx = 609.5593, kCy = 172.854;

struct K {
  double fx = kFocal, fy = kFocal, cx = kCx, cy = kCy;
};

/// What becomes of each image.
using Change = std::function<cv::Mat(const cv::Mat&)>;

cv::Mat as_it_is(const cv::Mat& image) {
  return image;
}

cv::Mat upside_down(const cv::Mat& image) {
  cv::Mat turned;
  cv::rotate(image, turned, cv::ROTATE_180);
  return turned;
}

/// By a camera whose right side hangs down: the road lies at the right of the picture.
cv::Mat portrait(const cv::Mat& image) {
  cv::Mat turned;
  cv::rotate(image, turned, cv::ROTATE_90_COUNTERCLOCKWISE);
  return turned;
}

cv::Mat halved(const cv::Mat& image) {
  cv::Mat half;
  cv::resize(image, half, {}, 0.5, 0.5, cv::INTER_AREA);
  return half;
}

constexpr K kUpsideDown{kFocal, kFocal, kWidth - 1.0 - kCx, kHeight - 1.0 - kCy};
constexpr K kPortrait{kFocal, kFocal, kCy, kWidth - 1.0 - kCx};

class TurnedKitti03 : public ::testing::Test {
 protected:
  static std::string data() {
    const char* folder = std::getenv("ONEAC_REAL_DATA");
    return (folder != nullptr ? folder : std::string(ONEAC_SOURCE_DIR) + "/../shared/data") +
           std::string("/kitti-03/");
  }

  /// Writes the changed drive and imports it. @return what the importer says
  std::string import(const Change& change, const K& k, const std::vector<std::string>& flags) {
    const fs::path source = folder_.path() / "drive";
    fs::create_directories(source / "images");
    for (int i = 0; i < kImages; ++i) {
      char name[32];
      std::snprintf(name, sizeof name, "%06d", i);
      const cv::Mat image = cv::imread(data() + "image_0/" + name + ".jpg", cv::IMREAD_GRAYSCALE);
      EXPECT_FALSE(image.empty()) << name;
      cv::imwrite((source / "images" / (std::string(name) + ".png")).string(), change(image));
    }
    fs::copy_file(data() + "times.txt", source / "times.txt", fs::copy_options::overwrite_existing);
    std::ofstream(source / "calib.txt")
        << "P0: " << k.fx << " 0 " << k.cx << " 0 0 " << k.fy << ' ' << k.cy << " 0 0 0 1 0\n";
    std::vector<std::string> words = {ONEAC_PROGRAM, "import", "kitti",           source.string(),
                                      "-o",          log_,     "--camera-height", "1.65"};
    words.insert(words.end(), flags.begin(), flags.end());
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.err;
  }

  void run(const std::vector<std::string>& flags = {}) {
    std::vector<std::string> words = {ONEAC_PROGRAM, "run", log_, "-o", out_, "--no-progress"};
    words.insert(words.end(), flags.begin(), flags.end());
    result_ = run_program(words);
    ASSERT_EQ(result_.exit_code, 0) << result_.err;
    std::ifstream in(out_ + "/summary.json");
    summary_ = nlohmann::json::parse(in);
  }

  void expect_right() const {
    EXPECT_NEAR(summary_["path_length"].get<double>(), kWay_m, 0.03 * kWay_m);
    EXPECT_GE(summary_["counts"]["steps_metric"].get<int>(), kImages - 4) << result_.err;
    EXPECT_TRUE(summary_["setup_faults"].empty()) << result_.err;
  }

  void expect_no_metres_because(const std::string& why) const {
    EXPECT_EQ(summary_["metric"], "none");
    for (const RelativePoseRow& row : read_relative_poses(out_ + "/relative_poses.csv")) {
      EXPECT_FALSE(row.metric) << row.index1;
      const double length = row.T_2_1.t.norm();
      EXPECT_TRUE(length == 0.0 || std::abs(length - 1.0) < 1e-6) << row.index1;
    }
    EXPECT_NE(result_.err.find(why), std::string::npos) << result_.err;
    EXPECT_NE(summary_["setup_faults"].dump().find(why), std::string::npos) << summary_;
  }

  const TemporaryFolder folder_;
  const std::string log_ = (folder_.path() / "turned.rawlog").string();
  const std::string out_ = (folder_.path() / "out").string();
  ProgramResult result_;
  nlohmann::json summary_;
};

TEST_F(TurnedKitti03, UpsideDownIsRightWhenTheLogTells) {
  import(upside_down, kUpsideDown, {"--mount-roll", "180"});
  run();
  expect_right();
}

TEST_F(TurnedKitti03, UpsideDownIsRightWhenTheFlagTells) {
  import(upside_down, kUpsideDown, {});
  run({"--mount-roll", "180"});
  expect_right();
}

TEST_F(TurnedKitti03, PortraitIsRightWhenTheLogTells) {
  import(portrait, kPortrait, {"--mount-roll", "90"});
  run();
  expect_right();
}

TEST_F(TurnedKitti03, UpsideDownHasNoMetresWhenNobodyTells) {
  import(upside_down, kUpsideDown, {});
  run();
  expect_no_metres_because("--mount-roll 180");
}

TEST_F(TurnedKitti03, PortraitHasNoMetresWhenNobodyTells) {
  import(portrait, kPortrait, {});
  run();
  expect_no_metres_because("--mount-roll 90");
}

TEST_F(TurnedKitti03, HasNoMetresByTheCalibrationOfLargerImages) {
  import(halved, {}, {});
  run();
  expect_no_metres_because("cx = 609.6 px lies beyond the middle half of 621 px");
}

TEST_F(TurnedKitti03, HasNoMetresByAFocalLengthOfFivePixels) {
  import(as_it_is, {5.0, 5.0, kCx, kCy}, {});
  run();
  expect_no_metres_because("field of view of 179.1°");
}

TEST_F(TurnedKitti03, HasNoMetresByASwappedPrincipalPoint) {
  import(as_it_is, {kFocal, kFocal, kCy, kCx}, {});
  run();
  expect_no_metres_because("cx = 172.9 px");
}

}  // namespace
}  // namespace oneac
