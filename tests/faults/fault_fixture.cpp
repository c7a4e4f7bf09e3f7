#include "fault_fixture.h"

#include "oneac/evaluation/trajectory_io.h"

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace oneac {

namespace fs = std::filesystem;

std::string file_content(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> file_names(const fs::path& folder) {
  std::vector<std::string> names;
  if (!fs::exists(folder)) return names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

cv::Mat textured(int shift) {
  constexpr int kBlock = 4;  // [px]
  cv::Mat image(test::kHeight, test::kWidth, CV_8U);
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const auto cell = static_cast<std::uint32_t>((u + shift) / kBlock * 73 + v / kBlock * 151);
      image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(cell * 2654435761U >> 24U);
    }
  }
  return image;
}

std::vector<std::string> FaultFixture::run_command(const std::vector<std::string>& extra) const {
  std::vector<std::string> command{ONEAC_PROGRAM, "run", log().string(), "-o", out().string()};
  command.insert(command.end(), extra.begin(), extra.end());
  return command;
}

ProgramResult FaultFixture::run(const std::vector<std::string>& extra) const {
  return run_program(run_command(extra));
}

test::Objects FaultFixture::textured_frames(int count) const {
  test::Objects objects;
  for (int i = 0; i < count; ++i) {
    const std::string name = "frame_" + std::to_string(i) + ".png";
    cv::imwrite((scratch() / name).string(), textured(i));
    objects.push_back(test::external_image("CAM", 0.1 * i, name));
  }
  return objects;
}

std::size_t FaultFixture::poses_written() const {
  const Trajectory trajectory = read_kitti(out() / "trajectory_camera.kitti");  // finite or throws
  return trajectory.poses.size();
}

void FaultFixture::expect_exit(const ProgramResult& result, int code,
                               const std::vector<std::string>& words) {
  EXPECT_EQ(result.exit_code, code) << result.err;
  for (const std::string& word : words) {
    EXPECT_NE(result.err.find(word), std::string::npos) << word << " is not in: " << result.err;
  }
  EXPECT_LT(result.peak_mb, 1024U);
  EXPECT_LT(result.cpu_seconds, 20.0) << "two threads, ten seconds";
}

}  // namespace oneac
