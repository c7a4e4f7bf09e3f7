#pragma once

#include "drive_record.h"

#include <filesystem>
#include <string>
#include <vector>

namespace oneac::app {

/// Writes the trajectories, relative_poses.csv, timings.csv; each whole or not at all.
void write_drive(const DriveRecord& record, const std::filesystem::path& folder);

/// The lines that tell the user about missing images, height, scale: one each, for stderr.
[[nodiscard]] std::vector<std::string> notes_about(const DriveRecord& record);

}  // namespace oneac::app
