#include "run_georeference.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/number_text.h"
#include "oneac/geometry/angles.h"
#include "oneac/rawlog/track_files.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace oneac::app {
namespace {

std::vector<PositionFix> fixes_of(const VehicleReference& reference) {
  std::vector<PositionFix> fixes;
  for (const GpsFix& fix : reference.gps) {
    if (fix.position_enu) fixes.push_back({fix.time_s, *fix.position_enu});
  }
  return fixes;
}

std::string described(const Georeference& joined) {
  return "vehicle's way by oneac, joined to " + std::to_string(joined.fixes) +
         " GPS positions; they lie " + fixed_text(joined.rms, 2) + " m (rms) beside it";
}

/// A file of positions alone has all of them at 0 m, where no road is to the millimetre.
bool tells_heights(const std::vector<PositionFix>& fixes, const GeodeticPosition& origin) {
  constexpr double kMillimetre = 1e-3;
  return std::any_of(fixes.begin(), fixes.end(), [&](const PositionFix& fix) {
    return std::abs(geodetic_from_enu(fix.enu, origin).altitude_m) > kMillimetre;
  });
}

Track track_of(const Trajectory& enu, const Georeference& joined, const GeodeticPosition& origin) {
  Track track{"oneac", described(joined), {}, true};
  for (std::size_t i = 0; i < enu.poses.size(); ++i) {
    const GeodeticPosition place = geodetic_from_enu(enu.poses[i].translation(), origin);
    // A drive that went astray where no fix saw it may have left the earth.
    if (std::abs(place.altitude_m) > SensorLimits::kHighest) continue;
    track.points.push_back({enu.times[i], place});
  }
  return track;
}

}  // namespace

GeoreferenceResult georeference_of(const DriveRecord& record) {
  const VehicleReference& reference = record.source.reference;
  const std::vector<PositionFix> fixes = fixes_of(reference);
  const Trajectory vehicle = fixes.empty() ? Trajectory{} : record.vehicle_trajectory();
  return georeference(vehicle, fixes, record.has_scale());
}

void write_georeferenced(const DriveRecord& record, const GeoreferenceResult& result, bool enu,
                         const std::filesystem::path& folder) {
  const std::optional<GeodeticFix>& origin = record.source.reference.origin;
  if (!result.found || !origin) return;
  const Trajectory moved = in_enu(record.vehicle_trajectory(), result.georeference);
  const GeodeticPosition from{origin->latitude_deg, origin->longitude_deg, origin->height};
  Track track = track_of(moved, result.georeference, from);
  track.has_heights = tells_heights(fixes_of(record.source.reference), from);
  write_file_atomically(folder / "trajectory.gpx", format_gpx(track));
  write_file_atomically(folder / "trajectory.kml", format_kml(track));
  if (enu) write_file_atomically(folder / "trajectory_enu.tum", format_tum(moved));
}

nlohmann::json georeference_json(const DriveRecord& record, const GeoreferenceResult& result) {
  const std::optional<GeodeticFix>& origin = record.source.reference.origin;
  if (!result.found || !origin) return {{"reason", result.reason}};
  const Georeference& joined = result.georeference;
  const Similarity& map = joined.enu_drive;
  return {{"origin",
           {{"latitude_deg", origin->latitude_deg},
            {"longitude_deg", origin->longitude_deg},
            {"height_m", origin->height}}},
          {"model", record.has_scale() ? "se2" : "similarity"},
          {"yaw_deg", std::atan2(map.R(1, 0), map.R(0, 0)) / kDegree},
          {"yaw_sigma_deg", joined.yaw_sigma / kDegree},
          {"scale", map.scale},
          {"shift_enu_m", {map.t.x(), map.t.y(), map.t.z()}},
          {"fixes", joined.fixes},
          {"residual_m", {{"rms", joined.rms}, {"median", joined.median}, {"max", joined.max}}}};
}

}  // namespace oneac::app
