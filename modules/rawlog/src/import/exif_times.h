#pragma once

#include "oneac/rawlog/import_report.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace oneac {

/// When a camera says that it took an image: DateTimeOriginal with SubSecTimeOriginal and
/// OffsetTimeOriginal.
struct ExifTime {
  double local_s = 0.0;          ///< Unix time, were the camera's clock one of UTC [s]
  bool has_fraction = false;     ///< parts of a second are told
  std::optional<double> zone_s;  ///< how much the clock is ahead of UTC [s]
};

/// Empty where the file is no JPEG, or has no such time.
[[nodiscard]] std::optional<ExifTime> exif_time(const std::filesystem::path& image);

/// The times of all images. Where they are used, a note says so, and what is known of the zone: an
/// image that tells none has that of the one before, and the first ones that of the first to tell.
/// @param fault  why there are none, in a few words; "" where there are
/// @return empty when one has no time, or is not later than the one before
[[nodiscard]] std::vector<double> stamps_from_exif(const std::vector<std::filesystem::path>& images,
                                                   ImportReport& report, std::string& fault);

/// Where a counter of the camera has begun anew (DSC9999, DSC0001), its second part comes first by
/// name: puts it behind the other where the EXIF times of all images say so, and notes it.
void unroll_counter(std::vector<std::filesystem::path>& images, ImportReport& report);

/// Notes images that EXIF says to show turned: they are taken as they are stored.
void note_orientation(const std::vector<std::filesystem::path>& images, ImportReport& report);

}  // namespace oneac
