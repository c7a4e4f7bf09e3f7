#pragma once

#include "oneac/frontend/front_end.h"
#include "oneac/test_support/program.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservationImage.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace oneac {

using Observations = std::vector<mrpt::obs::CObservation::Ptr>;

/// The observations of a log as MRPT reads them.
[[nodiscard]] Observations read_log(const std::filesystem::path& log);
/// Writes them, as MRPT does.
void write_log(const std::filesystem::path& log, const Observations& observations);

/// The poses that feed() makes of the observations, final, as `oneac run` writes them.
///
/// In the order that `oneac run` gives: the IMU of the whole drive first, speeds of the GPS a
/// second and a half ahead of the images, wheels as they come.
[[nodiscard]] std::string feed_all(const Observations& observations,
                                   const FrontEndOptions& options);
/// What the InputError says that feed() throws on the way; "" without one.
[[nodiscard]] std::string refusal_of_feed(const Observations& observations);

/// Runs the program on a log; its trajectory_camera.kitti, which holds every bit of the poses.
[[nodiscard]] std::string run_all(const std::filesystem::path& log,
                                  std::vector<std::string> arguments = {});

/// The same rows, of a camera that moved.
void expect_same(const std::string& fed, const std::string& run);

/// A short drive with GPS and IMU, rendered once per suite.
class LiveFixture : public ::testing::Test {
 protected:
  static void SetUpTestSuite();
  static void TearDownTestSuite();
  void SetUp() override;

  /// Writes the drive again with its image observations changed.
  [[nodiscard]] std::filesystem::path changed_log(
      const std::function<void(mrpt::obs::CObservationImage&, int)>& change) const;
  [[nodiscard]] static std::filesystem::path log() {
    return shared_->path() / "drive" / "simulated.rawlog";
  }
  [[nodiscard]] static std::filesystem::path images() { return shared_->path() / "drive/Images"; }
  [[nodiscard]] std::filesystem::path scratch() const { return scratch_.path(); }

 private:
  static std::unique_ptr<TemporaryFolder> shared_;
  TemporaryFolder scratch_;
};

}  // namespace oneac
