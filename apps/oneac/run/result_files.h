#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace oneac::app {

/// What a run is about to write, and what it reads.
struct ResultFolder {
  std::filesystem::path folder;
  bool learns_camera = false;       ///< camera.ini is written, too
  std::vector<std::string> inputs;  ///< files that the run reads; empty names are none
};

/// Before anything is taken away or computed: results replace those of an earlier run, not what
/// others have put there under their names, nor what this run reads. Opens no pipe.
/// @throws InputError naming what has the name of a result and is a folder, a device or a pipe, no
///         run has written, or is an input
void require_own_results(const ResultFolder& results);

/// Takes the files of an earlier run out of the folder, which is checked: it holds those of one run
/// only. What no run writes stays; the folders 1, 2, … of a run of several logs are cleared, too.
void clear_of_earlier_run(const std::filesystem::path& folder);

/// The results of a run that are in the folder, "trajectory_camera.kitti, trajectory_camera.tum,
/// …".
[[nodiscard]] std::string names_of_results(const std::filesystem::path& folder);

/// files.json: the results that are in the folder now, with frame, unit and rows.
/// @param metric  lengths are metres
[[nodiscard]] std::string manifest_json(const std::filesystem::path& folder, bool metric);

}  // namespace oneac::app
