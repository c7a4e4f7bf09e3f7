#pragma once

#include "oneac/rawlog/sensor_records.h"

#include <string>
#include <vector>

namespace oneac {

/// A point of a track.
struct TrackPoint {
  double time_s = 0.0;  ///< Unix time [s]
  GeodeticPosition place;
};

/// A track for maps. Text in UTF-8.
struct Track {
  std::string name;
  std::string description;  ///< one line
  std::vector<TrackPoint> points;
  bool has_heights = true;  ///< else altitudes are not told
};

/// As GPX 1.1: a track of one segment; degrees with eight decimals (1 mm), metres above the
/// ellipsoid, times in UTC with milliseconds.
/// @throws std::invalid_argument naming a point whose place or time is none
[[nodiscard]] std::string format_gpx(const Track& track);

/// As KML 2.2: a line that lies on the ground. @throws as format_gpx()
[[nodiscard]] std::string format_kml(const Track& track);

}  // namespace oneac
