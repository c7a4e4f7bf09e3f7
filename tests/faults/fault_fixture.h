#pragma once

#include "log_maker.h"

#include "oneac/test_support/program.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace oneac {

/// Logs of tiny images made for the test, and the program run on them.
class FaultFixture : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path scratch() const { return scratch_.path(); }
  [[nodiscard]] std::filesystem::path log() const { return scratch() / "drive.rawlog"; }
  [[nodiscard]] std::filesystem::path out() const { return scratch() / "out"; }

  /// `oneac run LOG -o out() extra...`
  [[nodiscard]] ProgramResult run(const std::vector<std::string>& extra = {}) const;
  [[nodiscard]] std::vector<std::string> run_command(
      const std::vector<std::string>& extra = {}) const;
  /// An image `frame_<i>.png` beside the log, textured, moved by i pixels; its observation.
  [[nodiscard]] test::Objects textured_frames(int count) const;
  /// Rows of trajectory_camera.kitti; all must be finite.
  [[nodiscard]] std::size_t poses_written() const;

  static void expect_exit(const ProgramResult& result, int code,
                          const std::vector<std::string>& words);

 private:
  TemporaryFolder scratch_;
};

[[nodiscard]] std::string file_content(const std::filesystem::path& path);
[[nodiscard]] std::vector<std::string> file_names(const std::filesystem::path& folder);

/// A grey image with corners everywhere.
[[nodiscard]] cv::Mat textured(int shift);

}  // namespace oneac
