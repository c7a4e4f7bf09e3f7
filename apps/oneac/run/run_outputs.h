#pragma once

#include "drive_record.h"

#include <filesystem>
#include <string>
#include <vector>

namespace oneac::app {

/// The camera that a run with a learned focal length used in the end, for --calibration: that of
/// the raw images, with its 1σ. Empty for a lens that is not plumb bob.
[[nodiscard]] std::string used_camera_ini(const DriveRecord& record, const std::string& log);

/// Writes the trajectories, relative_poses.csv, covariance.csv, tilt.csv, timings.csv, where there
/// are keyframes the map, where something was learned of the car mask.png; each whole or not at
/// all.
void write_drive(const DriveRecord& record, const std::filesystem::path& folder);

/// What the program ends with when the drive is not whole, after its files are written.
/// @throws InputError for an image or a log that cannot be read on, std::runtime_error when
/// interrupted
void fail_if_incomplete(const DriveRecord& record);

/// What the program ends with, instead of writing anything, when no frame was processed.
/// @throws as fail_if_incomplete, else InputError naming the log
void fail_if_empty(const DriveRecord& record, const std::string& log);

/// The line about a gyroscope that does not turn with the images, see fault_of_gyroscope(); else
/// "".
[[nodiscard]] std::string about_strange_gyroscope(const DriveRecord& record);

/// The lines that tell the user about missing images, height, scale: one each, for stderr.
[[nodiscard]] std::vector<std::string> notes_about(const DriveRecord& record);

}  // namespace oneac::app
