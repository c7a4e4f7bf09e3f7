#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace oneac {

/// What an importer has written.
struct ImportReport {
  std::filesystem::path log;
  std::filesystem::path poses;     ///< reference poses beside the log; empty: the source has none
  std::size_t images = 0;          ///< image files that the log refers to
  std::size_t observations = 0;    ///< of cameras: a stereo pair counts once
  std::size_t gps = 0;             ///< epochs
  std::size_t imu = 0;             ///< samples
  std::size_t wheels = 0;          ///< readings of an odometer
  std::vector<std::string> notes;  ///< one line each: what was assumed or left out
};

}  // namespace oneac
