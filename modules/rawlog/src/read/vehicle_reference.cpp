#include "oneac/rawlog/vehicle_reference.h"

#include "oneac/rawlog/sensor_records.h"

#include <mrpt/topography/conversions.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace oneac {
namespace {

constexpr double kCoverWithin = 1.5;  // [s] how far an end of the interval may lie from the data
constexpr double kLongestGap = 5.0;   // [s] over which nothing is interpolated
constexpr double kStanding = 0.5;     // [m/s] below which the course of a GPS is noise
constexpr double kTellingWay = 5.0;   // [m] between two positions, whose noise is a metre or two

struct Sample {
  double time_s;
  double value;
};
using Samples = std::vector<Sample>;

// The samples that matter to [t0, t1]: inside it and the nearest on either side. Empty when the
// data does not reach both ends or has a long gap.
Samples covering(const Samples& all, double t0, double t1) {
  if (!(t0 <= t1) || all.size() < 2) return {};
  const auto earlier = [](const Sample& s, double t) { return s.time_s < t; };
  auto first = std::lower_bound(all.begin(), all.end(), t0, earlier);
  auto last = std::lower_bound(all.begin(), all.end(), t1, earlier);
  if (first == all.end() || first->time_s > t0) first -= first == all.begin() ? 0 : 1;
  if (last != all.end()) ++last;
  const Samples part(first, last);
  if (part.size() < 2) return {};
  const bool reaches =
      part.front().time_s <= t0 + kCoverWithin && part.back().time_s >= t1 - kCoverWithin;
  const auto gap = std::adjacent_find(
      part.begin(), part.end(),
      [](const Sample& a, const Sample& b) { return b.time_s - a.time_s > kLongestGap; });
  return reaches && gap == part.end() ? part : Samples{};
}

// Linear between samples, constant beyond them. @pre not empty, in time order
double value_at(const Samples& samples, double t) {
  const auto next = std::upper_bound(samples.begin(), samples.end(), t,
                                     [](double time, const Sample& s) { return time < s.time_s; });
  if (next == samples.begin()) return samples.front().value;
  if (next == samples.end()) return samples.back().value;
  const auto& a = *(next - 1);
  const double share = (t - a.time_s) / (next->time_s - a.time_s);
  return a.value + share * (next->value - a.value);
}

// The courses without jumps of a full turn; while the vehicle stands, the last one is held.
Samples unwrapped_courses(const std::vector<GpsFix>& gps) {
  Samples courses;
  const auto standing = [](const GpsFix& fix) { return fix.speed && *fix.speed < kStanding; };
  const auto moving = std::find_if(gps.begin(), gps.end(),
                                   [&](const GpsFix& fix) { return fix.course && !standing(fix); });
  if (moving == gps.end()) return {};
  double heading = *moving->course;
  for (const auto& fix : gps) {
    if (!fix.course) continue;
    if (!standing(fix)) heading += std::remainder(*fix.course - heading, 2.0 * M_PI);
    courses.push_back({fix.time_s, heading});
  }
  return courses;
}

/// The fixes with a position around t: the last one before it, the first one at or after it; null
/// where there is none.
std::pair<const GpsFix*, const GpsFix*> around(const std::vector<GpsFix>& gps, double t) {
  const auto next = std::lower_bound(gps.begin(), gps.end(), t,
                                     [](const GpsFix& f, double time) { return f.time_s < time; });
  const auto has_position = [](const GpsFix& fix) { return fix.position_enu.has_value(); };
  const auto after = std::find_if(next, gps.end(), has_position);
  const auto before = std::find_if(std::make_reverse_iterator(next), gps.rend(), has_position);
  return {before == gps.rend() ? nullptr : &*before, after == gps.end() ? nullptr : &*after};
}

/// [m] Earth-centred; below or above the point.
Eigen::Vector3d on_ellipsoid(const Eigen::Vector3d& enu, const GeodeticFix& origin) {
  const GeodeticPosition here =
      geodetic_from_enu(enu, {origin.latitude_deg, origin.longitude_deg, origin.height});
  mrpt::math::TPoint3D earth;
  mrpt::topography::geodeticToGeocentric_WGS84({here.latitude_deg, here.longitude_deg, 0.0}, earth);
  return {earth.x, earth.y, earth.z};
}

}  // namespace

std::optional<double> VehicleReference::heading_change(double t0, double t1) const {
  const Samples courses = covering(unwrapped_courses(gps), t0, t1);
  if (courses.empty()) return std::nullopt;
  // A course turns clockwise, a heading counter-clockwise.
  return value_at(courses, t0) - value_at(courses, t1);
}

std::optional<double> VehicleReference::distance(double t0, double t1) const {
  Samples stated;
  for (const auto& fix : gps) {
    if (fix.speed) stated.push_back({fix.time_s, *fix.speed});
  }
  stated = covering(stated, t0, t1);
  if (stated.empty()) return std::nullopt;
  double length = 0.0;
  Sample previous{t0, value_at(stated, t0)};
  const auto advance = [&](const Sample& to) {
    length += 0.5 * (previous.value + to.value) * (to.time_s - previous.time_s);
    previous = to;
  };
  for (const auto& sample : stated) {
    if (sample.time_s > t0 && sample.time_s < t1) advance(sample);
  }
  advance({t1, value_at(stated, t1)});
  return length;
}

std::optional<EarthPlace> VehicleReference::place(double t) const {
  const auto [before, after] = around(gps, t);
  if (!origin || before == nullptr || after == nullptr) return std::nullopt;
  const double gap = after->time_s - before->time_s;
  if (!(gap <= kLongestGap)) return std::nullopt;
  const Eigen::Vector3d way = *after->position_enu - *before->position_enu;
  const double share = gap > 0.0 ? (t - before->time_s) / gap : 0.0;
  EarthPlace place;
  place.point = on_ellipsoid(*before->position_enu + share * way, *origin);
  if (way.head<2>().norm() > kTellingWay) place.course = std::atan2(way.x(), way.y());
  return place;
}

}  // namespace oneac
