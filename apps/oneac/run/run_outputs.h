#pragma once

#include "drive_record.h"

#include <filesystem>
#include <string>
#include <vector>

namespace oneac::app {

/// Takes the files of an earlier run out of the folder: it holds those of one run only. What no run
/// writes stays. @throws OutputError naming what has the name of a result and is no file
void clear_of_earlier_run(const std::filesystem::path& folder);

/// Before a drive that writes camera.ini: one that no run has written, such as that of oneac
/// calibrate, is nobody's to overwrite. @throws InputError naming it
void require_no_other_camera(const std::filesystem::path& folder);

/// The same of trajectory.gpx, trajectory.kml and files.json, names that people use themselves.
void require_no_other_results(const std::filesystem::path& folder);

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

/// The lines that tell the user about missing images, height, scale: one each, for stderr.
[[nodiscard]] std::vector<std::string> notes_about(const DriveRecord& record);

}  // namespace oneac::app
