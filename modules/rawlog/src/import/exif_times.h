#pragma once

#include "oneac/rawlog/import_report.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace oneac {

/// Unix time [s] at which a camera says that it took the image: DateTimeOriginal with
/// SubSecTimeOriginal, taken for UTC unless OffsetTimeOriginal tells the zone.
struct ExifTime {
  double time_s = 0.0;
  bool has_fraction = false;  ///< parts of a second are told
  bool has_zone = false;
};

/// Empty where the file is no JPEG, or has no such time.
[[nodiscard]] std::optional<ExifTime> exif_time(const std::filesystem::path& image);

/// The times of all images. Where they are used, a note says so, and that the zone is not known.
/// @param fault  why there are none, in a few words; "" where there are
/// @return empty when one has no time, or is not later than the one before
[[nodiscard]] std::vector<double> stamps_from_exif(const std::vector<std::filesystem::path>& images,
                                                   ImportReport& report, std::string& fault);

}  // namespace oneac
