#include "oneac/rawlog/track_files.h"

#include "oneac/base/number_text.h"
#include "oneac/base/version.h"
#include "oneac/observations/sensor_readings.h"

#include <cmath>
#include <cstdio>
#include <ctime>
#include <stdexcept>

namespace oneac {
namespace {

constexpr int kDegreeDecimals = 8, kMetreDecimals = 3;

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&') {
      safe += "&amp;";
    } else if (c == '<') {
      safe += "&lt;";
    } else if (c == '>') {
      safe += "&gt;";
    } else {
      safe += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;  // XML 1.0 has no control characters
    }
  }
  return safe;
}

void require_place(const TrackPoint& point, std::size_t number) {
  const GeodeticPosition& p = point.place;
  const bool good = std::abs(p.latitude_deg) <= 90.0 && std::abs(p.longitude_deg) <= 180.0 &&
                    std::abs(p.altitude_m) <= SensorLimits::kHighest &&
                    std::abs(point.time_s) <= SensorLimits::kLatest;
  if (!good) {
    throw std::invalid_argument("Track.points[" + std::to_string(number) +
                                "], must be a place on earth at a time");
  }
}

/// GPX takes longitudes from −180 up to, but not, 180.
double longitude(double degrees) {
  return degrees >= 180.0 ? degrees - 360.0 : degrees;
}

/// "2009-12-05T10:00:00.250Z".
std::string utc(double time_s) {
  const auto milliseconds = static_cast<long long>(std::llround(time_s * 1000.0));
  const long long rest = ((milliseconds % 1000) + 1000) % 1000;
  const auto seconds = static_cast<std::time_t>((milliseconds - rest) / 1000);
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  char text[64];
  std::snprintf(text, sizeof text, "%04d-%02d-%02dT%02d:%02d:%02d.%03dZ", parts.tm_year + 1900,
                parts.tm_mon + 1, parts.tm_mday, parts.tm_hour, parts.tm_min, parts.tm_sec,
                static_cast<int>(rest));
  return text;
}

}  // namespace

std::string format_gpx(const Track& track) {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<gpx version=\"1.1\" creator=\"oneac " +
      escaped(version()) + "\" xmlns=\"http://www.topografix.com/GPX/1/1\">\n  <trk>\n    <name>" +
      escaped(track.name) + "</name>\n    <desc>" + escaped(track.description) +
      "</desc>\n    <trkseg>\n";
  for (std::size_t i = 0; i < track.points.size(); ++i) {
    const TrackPoint& point = track.points[i];
    require_place(point, i);
    text += "      <trkpt lat=\"" + fixed_text(point.place.latitude_deg, kDegreeDecimals) +
            "\" lon=\"" + fixed_text(longitude(point.place.longitude_deg), kDegreeDecimals) + "\">";
    if (track.has_heights) {
      text += "<ele>" + fixed_text(point.place.altitude_m, kMetreDecimals) + "</ele>";
    }
    text += "<time>" + utc(point.time_s) + "</time></trkpt>\n";
  }
  return text + "    </trkseg>\n  </trk>\n</gpx>\n";
}

std::string format_kml(const Track& track) {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<kml xmlns=\"http://www.opengis.net/kml/2.2\">\n  <Document>\n    <name>" +
      escaped(track.name) + "</name>\n    <description>" + escaped(track.description) +
      "</description>\n    <Style id=\"way\"><LineStyle><color>ffd0762a</color><width>4</width>"
      "</LineStyle></Style>\n    <Placemark>\n      <name>" +
      escaped(track.name) +
      "</name>\n      <styleUrl>#way</styleUrl>\n      <LineString>\n        "
      "<tessellate>1</tessellate>\n        <altitudeMode>clampToGround</altitudeMode>\n        "
      "<coordinates>\n";
  for (std::size_t i = 0; i < track.points.size(); ++i) {
    require_place(track.points[i], i);
    const GeodeticPosition& place = track.points[i].place;
    text += "          " + fixed_text(longitude(place.longitude_deg), kDegreeDecimals) + "," +
            fixed_text(place.latitude_deg, kDegreeDecimals);
    if (track.has_heights) text += "," + fixed_text(place.altitude_m, kMetreDecimals);
    text += "\n";
  }
  return text +
         "        </coordinates>\n      </LineString>\n    </Placemark>\n  </Document>\n</kml>\n";
}

}  // namespace oneac
