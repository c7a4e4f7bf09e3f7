#pragma once

#include "oneac/rawlog/import_report.h"
#include "oneac/rawlog/sensor_records.h"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace oneac {

// Positions of a receiver out of a file of its own, put in order (gps_order.h); fixes that are void
// or left out there are counted in the notes. A height that is not told is that of the fixes
// around.
// @throws InputError naming file and line, what is wrong with it and the cure

/// NMEA 0183: RMC sentences (date, position, speed, course) with the altitude and quality of the
/// GGA of the same moment. Sentences with a wrong checksum are passed over.
[[nodiscard]] std::vector<GpsRecord> read_nmea(const std::filesystem::path& file,
                                               ImportReport& report);

/// A table whose first line names its columns: time (since 1970 in s, ms, us or ns, or as
/// 2024-05-01T10:00:00Z), lat, lon in degrees; ele [m], speed_mps, speed_kmh or speed_knots and
/// course [deg] where it has them. A speed without unit is not taken.
[[nodiscard]] std::vector<GpsRecord> read_gps_csv(const std::filesystem::path& file,
                                                  ImportReport& report);

/// GPX: the points of its tracks, with their time and ele.
[[nodiscard]] std::vector<GpsRecord> read_gpx(const std::filesystem::path& file,
                                              ImportReport& report);

/// Notes how many of a file's times name no zone, if any: receivers in a country's own time put the
/// track hours away from the images.
void note_times_without_zone(std::size_t count, const std::filesystem::path& file,
                             ImportReport& report);

}  // namespace oneac
