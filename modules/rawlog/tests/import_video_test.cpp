// Frames of videos with B-frames: their times, and what is said of a video that is cut or damaged.
#include "video_maker.h"
#include "writing_support.h"

#include "oneac/rawlog/import_drive.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationImage.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <array>
#include <cstdint>
#include <filesystem>

namespace oneac {
namespace {

namespace fs = std::filesystem;
using mrpt::obs::CObservationImage;
using test::read_text;
using test::write_text;

class ImportVideoFrames : public ::testing::Test {
 protected:
  ImportVideoFrames() {
    options_.source = folder_.path() / "drive.mp4";
    options_.log = folder_.path() / "out" / "drive.rawlog";
    options_.calibration = (folder_.path() / "cameras.txt").string();
    options_.camera_height_m = 1.4;
    options_.start = "1714557600";
    write_text(options_.calibration, "1 PINHOLE 64 48 50 51 32.5 24.5\n");
  }
  /// Ten frames a second.
  void make_video(const std::string& name, int frames) {
    options_.source = folder_.path() / name;
    std::vector<int> times_ms;
    for (int i = 0; i < frames; ++i) times_ms.push_back(100 * i);
    test::write_video(options_.source, times_ms);
  }
  [[nodiscard]] std::vector<double> times() const {
    std::vector<double> all;
    for (const auto& image : test::only<CObservationImage>(test::read_with_mrpt(options_.log))) {
      all.push_back(mrpt::Clock::toDouble(image->timestamp) - 1714557600.0);
    }
    return all;
  }
  /// All notes of the import.
  [[nodiscard]] std::string noted() const {
    std::string text;
    for (const std::string& note : import_video(options_).notes) text += note + '\n';
    return text;
  }
  /// Keeps the first part of the file.
  void cut_to(double share) const {
    const std::string bytes = read_text(options_.source);
    const auto kept = static_cast<std::size_t>(share * static_cast<double>(bytes.size()));
    write_text(options_.source, bytes.substr(0, kept));
  }

  TemporaryFolder folder_;
  VideoImport options_;
};

TEST_F(ImportVideoFrames, HaveTheTimesOfTheFileToTheLastOne) {
  const std::vector<int> times_ms{0, 100, 150, 400, 450, 500, 700, 1000, 1040, 1500, 1510, 1900};
  for (const char* name : {"drive.mp4", "drive.mkv", "drive.mov"}) {
    options_.source = folder_.path() / name;
    test::write_video(options_.source, times_ms);
    EXPECT_EQ(noted().find("no time"), std::string::npos) << name;
    const std::vector<double> found = times();
    ASSERT_EQ(found.size(), times_ms.size()) << name;
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i], 1e-3 * times_ms[i], 1e-6) << name << ": frame " << i;
    }
  }
}

TEST_F(ImportVideoFrames, OfACutFileAreCounted) {
  for (const char* name : {"drive.mkv", "drive.avi"}) {
    make_video(name, 120);
    EXPECT_EQ(noted().find("the file ends"), std::string::npos) << name << ": " << noted();
    cut_to(0.6);
    EXPECT_NE(noted().find("s before the time that it says, cut off or damaged"), std::string::npos)
        << name << ": " << noted();
  }
  EXPECT_NE(noted().find(" of 120 frames: the file ends"), std::string::npos) << noted();
  options_.to_s = 0.5;  // the frames to there are all there
  EXPECT_EQ(noted().find("the file ends"), std::string::npos) << noted();
}

TEST_F(ImportVideoFrames, ThatAreDamagedAreCounted) {
  make_video("drive.mkv", 60);
  EXPECT_EQ(noted().find("damage"), std::string::npos) << noted();
  std::string bytes = read_text(options_.source);
  for (const double share : {0.3, 0.6}) {
    const auto at = static_cast<std::size_t>(share * static_cast<double>(bytes.size()));
    bytes.replace(at, 40, std::string(40, '\x55'));
  }
  write_text(options_.source, bytes);
  EXPECT_NE(noted().find("FFmpeg finds damage at "), std::string::npos) << noted();
}

TEST_F(ImportVideoFrames, OfANameWithAColonAreRead) {
  make_video("10:30.mp4", 5);
  EXPECT_NE(noted().find("5 frames decoded"), std::string::npos);
}

TEST_F(ImportVideoFrames, AreTurnedAsPlayersTurnThem) {
  make_video("drive.mp4", 5);
  import_video(options_);
  const fs::path png = options_.log.parent_path() / "drive_Images" / "000003.png";
  cv::Mat expected;
  cv::rotate(cv::imread(png.string()), expected, cv::ROTATE_90_CLOCKWISE);
  // The matrix of the track's head: x' = 48 - y, y' = x.
  constexpr std::array<std::uint32_t, 9> kMatrix{0, 0x10000,    0, 0xFFFF0000, 0,
                                                 0, 48U << 16U, 0, 0x40000000};
  std::string bytes = read_text(options_.source);
  std::size_t at = bytes.find("tkhd") + 4 + 40;
  for (const std::uint32_t entry : kMatrix) {
    for (unsigned shift = 32; shift > 0; shift -= 8) {
      bytes[at++] = static_cast<char>(entry >> (shift - 8) & 0xffU);
    }
  }
  write_text(options_.source, bytes);
  write_text(options_.calibration, "1 PINHOLE 48 64 50 51 24.5 32.5\n");
  import_video(options_);
  const cv::Mat found = cv::imread(png.string());
  ASSERT_EQ(found.size(), expected.size());
  EXPECT_EQ(cv::norm(found, expected, cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace oneac
