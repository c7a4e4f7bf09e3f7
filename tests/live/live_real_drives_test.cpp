#include "live_support.h"

#include "oneac/rawlog/calibration.h"

#include <mrpt/img/CImage.h>

#include <cstdlib>
#include <filesystem>

namespace oneac {
namespace {

std::string data_folder() {
  const char* folder = std::getenv("ONEAC_REAL_DATA");
  return folder != nullptr ? folder : std::string(ONEAC_SOURCE_DIR) + "/../shared/data";
}

/// As many observations as it takes to have so many images.
Observations beginning(Observations observations, std::size_t images) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const std::string name = observations[i]->GetRuntimeClass()->className;
    if (name.find("Image") == std::string::npos || ++count < images) continue;
    observations.resize(i + 1);
    break;
  }
  return observations;
}

class LiveRealDrives : public ::testing::Test {
 protected:
  static constexpr std::size_t kImages = 25;

  /// Imports the data set's first images.
  [[nodiscard]] std::filesystem::path imported(const std::string& kind, const std::string& name) {
    const auto all = folder_.path() / "all.rawlog";
    const ProgramResult import = run_program(
        {ONEAC_PROGRAM, "import", kind, data_folder() + "/" + name, "-o", all.string()});
    EXPECT_EQ(import.exit_code, 0) << import.err;
    const auto log = folder_.path() / "log.rawlog";
    write_log(log, beginning(read_log(all), kImages));
    return log;
  }
  TemporaryFolder folder_;
};

TEST_F(LiveRealDrives, Kitti03) {
  const auto log = imported("kitti", "kitti-03");
  FrontEndOptions options;
  options.camera_height = 1.65;
  expect_same(feed_all(read_log(log), options),
              run_all(log, {"--set", "front_end.camera_height=1.65"}));
}

TEST_F(LiveRealDrives, Malaga04a) {
  if (!std::filesystem::exists(data_folder() + "/malaga-04a")) GTEST_SKIP() << "no such drive here";
  const auto log = imported("malaga", "malaga-04a");
  expect_same(feed_all(read_log(log), {}), run_all(log));
}

// The log's own calibration is that of the raw images, which are rectified.
TEST_F(LiveRealDrives, Malaga07) {
  const std::string data = data_folder() + "/malaga-07/";
  const std::string calibration = data + "camera_params_rectified_a=0_1024x768.txt:CAMERA_RIGHT";
  const std::string log = data + "malaga-urban-dataset-extract-07_CAM_GPS.rawlog";
  FrontEndOptions options;
  options.camera = "right";
  options.calibration = load_calibration(calibration, "right");
  mrpt::img::CImage::setImagesPathBase(data + "Images");
  const auto fed = feed_all(read_log(log), options);
  expect_same(fed, run_all(log, {"--camera", "right", "--calibration", calibration}));
}

}  // namespace
}  // namespace oneac
