#pragma once

#include "oneac/rawlog/import_report.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oneac {

/// Stands for the first image where the day is not known: 26 September 2011, KITTI's [s].
inline constexpr double kImportEpoch_s = 1317016800.0;

/// Row of a table that belongs to each image: the numbers in their names where all of them are
/// rows, else their order; empty when neither fits.
[[nodiscard]] std::vector<std::size_t> rows_of(const std::vector<std::filesystem::path>& images,
                                               std::size_t rows);

/// "11 rows for 10 images"
[[nodiscard]] std::string counts(std::size_t rows, std::size_t images);

/// Unix times [s] of images out of a table with a time per row in s, ms, us or ns, told by their
/// spacing; counted from kImportEpoch_s where they begin at 0. What unit it is goes to the notes.
/// @throws InputError naming the row that is no time, or is not later than the one before
[[nodiscard]] std::vector<double> stamps_from_table(
    const std::filesystem::path& file, const std::vector<std::filesystem::path>& images,
    ImportReport& report);

/// Unix times [s] that names hold ("1403636579763555584.png", "frame_1311868164.363181.jpg") in s,
/// ms, us or ns, told by their size: all of them, later than the one before; else empty.
[[nodiscard]] std::vector<double> stamps_from_names(
    const std::vector<std::filesystem::path>& images);

/// Unix time [s] of "2011-09-26 13:02:25.594360375" or "2011-09-26T13:02:25Z", taken for UTC.
[[nodiscard]] std::optional<double> date_stamp(const std::string& text);

/// Whether such a date says its zone; where it does not, it was taken as UTC.
[[nodiscard]] bool names_zone(std::string_view date);

/// Unix times [s] of lines "2011-09-26 13:02:25.594360375", taken for UTC.
/// @throws InputError naming file and line
[[nodiscard]] std::vector<double> read_date_stamps(const std::filesystem::path& file);

/// So many times per second, from kImportEpoch_s on.
[[nodiscard]] std::vector<double> stamps_at_rate(std::size_t images, double rate_hz);

/// Unix time [s] of a count of s, ms, us or ns since 1970, as digits with or without a decimal
/// point; negative where its size is of none of them.
[[nodiscard]] double seconds_since_1970(const std::string& digits);

/// @throws InputError naming the first image that is not later than the one before
void require_increasing(const std::vector<double>& times,
                        const std::vector<std::filesystem::path>& images,
                        const std::filesystem::path& file);

}  // namespace oneac
