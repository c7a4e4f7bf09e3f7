#pragma once

#include <filesystem>
#include <string>

namespace oneac::app {

/// Takes the files of an earlier run out of the folder: it holds those of one run only. What no run
/// writes stays; the folders 1, 2, … of a run of several logs are cleared, too. @throws OutputError
/// naming what has the name of a result and is no file
void clear_of_earlier_run(const std::filesystem::path& folder);

/// Before a drive that writes camera.ini: one that no run has written, such as that of oneac
/// calibrate, is nobody's to overwrite. @throws InputError naming it
void require_no_other_camera(const std::filesystem::path& folder);

/// The same of trajectory.gpx, trajectory.kml and files.json, names that people use themselves.
void require_no_other_results(const std::filesystem::path& folder);

/// The results of a run that are in the folder, "trajectory_camera.kitti, trajectory_camera.tum,
/// …".
[[nodiscard]] std::string names_of_results(const std::filesystem::path& folder);

/// files.json: the results that are in the folder now, with frame, unit and rows.
/// @param metric  lengths are metres
[[nodiscard]] std::string manifest_json(const std::filesystem::path& folder, bool metric);

}  // namespace oneac::app
