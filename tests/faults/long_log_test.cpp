#include "fault_fixture.h"

#include "oneac/test_support/sanitized.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace oneac {
namespace {

/// ONEAC_LONG_LOG sets the number of frames; the documented run has 100 000. A tenth of them has to
/// fit into the memory of the record, the whole has not.
int long_log_frames() {
  const char* frames = std::getenv("ONEAC_LONG_LOG");
  if (frames != nullptr) return std::max(std::atoi(frames), 200);
  return kSanitized ? 1500 : 6000;
}

/// Files that a run has begun and not finished.
bool has_leftovers(const std::filesystem::path& folder) {
  const std::vector<std::string> names = file_names(folder);
  return std::any_of(names.begin(), names.end(), [](const std::string& name) {
    return name.find(".part") != std::string::npos || name.front() == '.';
  });
}

class LongLog : public FaultFixture {
 protected:
  static constexpr int kFiles = 30;

  void SetUp() override {
    const ProgramResult made = run_program(
        {ONEAC_PROGRAM, "simulate", "-o", (scratch() / "drive").string(), "--frames",
         std::to_string(kFiles), "--width", "160", "--height", "120", "--focal", "125"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    for (const std::string& name : file_names(scratch() / "drive" / "Images")) {
      images_.push_back((scratch() / "drive" / "Images" / name).string());
    }
    ASSERT_EQ(images_.size(), static_cast<std::size_t>(kFiles));
    test::write_bytes(scratch() / "camera.ini",
                      "[CAM]\nresolution=[160 120]\ncx=79.5\ncy=59.5\nfx=125\nfy=125\n");
  }

  /// A street driven to and fro, `frames` images.
  [[nodiscard]] ProgramResult run_frames(int frames) const {
    test::Objects objects;
    for (int i = 0; i < frames; ++i) {
      const int phase = i % (2 * kFiles - 2);
      const int file = phase < kFiles ? phase : 2 * kFiles - 2 - phase;
      objects.push_back(
          test::external_image("CAM", 0.1 * i, images_[static_cast<std::size_t>(file)]));
    }
    test::write_log(log(), objects, test::Packing::gzip);
    return run({"--quiet", "--calibration", (scratch() / "camera.ini").string(), "--set",
                "front_end.camera_height=1.6"});
  }

 private:
  std::vector<std::string> images_;
};

TEST_F(LongLog, TakesHardlyMoreMemoryThanAShortOne) {
  const int frames = long_log_frames();
  const ProgramResult part = run_frames(frames / 10);
  const std::string tilts = file_content(out() / "tilt.csv");
  const ProgramResult whole = run_frames(frames);
  EXPECT_EQ(part.exit_code, 0) << part.err;
  EXPECT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_EQ(poses_written(), static_cast<std::size_t>(frames));
  EXPECT_TRUE(std::filesystem::exists(out() / "keyframes.tum")) << "nothing was tracked";
  std::printf("%d frames: %zu MB, %d frames: %zu MB, %.1f s of CPU time\n", frames / 10,
              part.peak_mb, frames, whole.peak_mb, whole.cpu_seconds);
  EXPECT_EQ(file_content(out() / "tilt.csv").substr(0, tilts.size()), tilts)
      << "what lay on the disk is not what memory holds";
  EXPECT_FALSE(tilts.empty());
  EXPECT_FALSE(has_leftovers(out()));
  if (kSanitized) return;
  // The record's frames, keyframes and points: 1 MiB each. Kept whole they take 2.5 kB a frame.
  constexpr double kRecord_mb = 8.0, kPerFrame_mb = 3e-4;
  EXPECT_LT(static_cast<double>(whole.peak_mb),
            static_cast<double>(part.peak_mb) + kRecord_mb + kPerFrame_mb * frames);
}

}  // namespace
}  // namespace oneac
