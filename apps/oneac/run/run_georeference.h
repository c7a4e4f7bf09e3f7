#pragma once

#include "drive_record.h"

#include "oneac/evaluation/georeference.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>

namespace oneac::app {

/// Joins the drive to the log's GPS, or says why not.
[[nodiscard]] GeoreferenceResult georeference_of(const DriveRecord& record);

/// trajectory.gpx and trajectory.kml, where there is a georeference; with `enu` also
/// trajectory_enu.tum, the vehicle east, north and up of the first fix.
void write_georeferenced(const DriveRecord& record, const GeoreferenceResult& result, bool enu,
                         const std::filesystem::path& folder);

/// Of summary.json: origin, turn, scale, shift and residual, or the reason for none.
[[nodiscard]] nlohmann::json georeference_json(const DriveRecord& record,
                                               const GeoreferenceResult& result);

}  // namespace oneac::app
