#include "calibrate/camera_height.h"

#include "run/gps_lag.h"

#include "oneac/base/number_text.h"
#include "oneac/geometry/angles.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>

namespace oneac::app {
namespace {

// A stretch: as long as two epochs of a receiver, as far as noise of 0.1 m matters little.
constexpr double kStretch_s = 2.0, kLeastWay = 5.0;
constexpr double kStraight = 5.0 * kDegree;  // the turn in it
// [s] Wheels come ten times a second and more, a receiver once; one epoch may be missing.
constexpr double kLongestGap = 2.5;
constexpr double kLatency = 0.2;  // [s] 1σ: receivers filter, and stamp late
// [-] 1σ that all ways share: a receiver's Doppler has none but noise on its own size, baselines
// of stereo are known to a millimetre of 120.
constexpr double kGpsShared = 0.005, kStereoShared = 0.01;
// [-] 1σ of one way by stereo, whose steps share landmarks.
constexpr double kStereoWay = 0.02;
// [-] a height that is worse makes lengths that are not metric.
constexpr double kUseful = 0.06;

/// A way in metres with the 1σ that is its own; empty where it is not known from end to end.
struct Way {
  double metres, sigma;
};
using WayTeller = std::function<std::optional<Way>(double begin_s, double end_s)>;

/// The way by speeds, which change linearly from one to the next.
std::optional<Way> way_by(const std::vector<SpeedReading>& speeds, double begin, double end) {
  const auto later = [](double t, const SpeedReading& s) { return t < s.time_s; };
  auto next = std::upper_bound(speeds.begin(), speeds.end(), begin, later);
  if (next == speeds.begin()) return std::nullopt;
  Way way{0.0, 0.0};
  double variance = 0.0, slowest = INFINITY, fastest = 0.0;
  for (double time = begin; time < end; ++next) {
    if (next == speeds.end()) return std::nullopt;
    const SpeedReading &a = *(next - 1), &b = *next;
    const double gap = b.time_s - a.time_s, until = std::min(b.time_s, end);
    if (!(gap > 0.0) || gap > kLongestGap) return std::nullopt;
    const double middle = 0.5 * (time + until) - a.time_s;
    const double speed = a.speed + (b.speed - a.speed) * middle / gap;
    way.metres += speed * (until - time);
    variance += a.sigma * a.sigma * gap * (until - time);
    slowest = std::min({slowest, a.speed, b.speed});
    fastest = std::max({fastest, a.speed, b.speed});
    time = until;
  }
  way.sigma = std::hypot(std::sqrt(variance), kLatency * (fastest - slowest));
  return way;
}

/// A frame on the way by the images.
struct Place {
  double time_s = 0.0;
  double way = 0.0;     ///< [m] from the first
  double turned = 0.0;  ///< [rad] from the first, whatever the side
  bool metric = false;  ///< the step that ends here is in metres
};

std::vector<Place> places_of(const DriveRecord& drive) {
  const Trajectory vehicle = drive.vehicle_trajectory();
  std::vector<Place> places;
  for (std::size_t i = 0; i < vehicle.poses.size(); ++i) {
    Place place{vehicle.times[i], 0.0, 0.0, false};
    if (i > 0) {
      const Eigen::Isometry3d step = vehicle.poses[i - 1].inverse() * vehicle.poses[i];
      const std::optional<StepResult> told = drive.frames[i].step;
      place.way = places.back().way + step.translation().norm();
      place.turned = places.back().turned + Eigen::AngleAxisd(step.linear()).angle();
      place.metric = told && told->metric && told->status != StepStatus::kPredicted;
    }
    places.push_back(place);
  }
  return places;
}

/// The way by the images between two of its frames.
std::optional<Way> way_by(const std::vector<Place>& places, double begin, double end) {
  const auto earlier = [](const Place& p, double t) { return p.time_s < t; };
  const auto a = std::lower_bound(places.begin(), places.end(), begin, earlier);
  const auto b = std::lower_bound(places.begin(), places.end(), end, earlier);
  const bool there = a != places.end() && b != places.end() && a->time_s == begin &&
                     b->time_s == end && a != b &&
                     std::all_of(a + 1, b + 1, [](const Place& p) { return p.metric; });
  if (!there) return std::nullopt;
  const double metres = b->way - a->way;
  return Way{metres, std::max(kStereoWay * metres, 1e-3)};
}

/// Straight stretches that both saw.
std::vector<WaySpan> spans_of(const std::vector<Place>& road, const WayTeller& sensor) {
  std::vector<WaySpan> spans;
  std::size_t begin = 0;
  for (std::size_t i = 1; i < road.size(); ++i) {
    if (!road[i].metric) begin = i;
    if (road[i].time_s - road[begin].time_s < kStretch_s) continue;
    const double turn = road[i].turned - road[begin].turned;
    const auto told = sensor(road[begin].time_s, road[i].time_s);
    if (told && turn < kStraight && told->metres >= kLeastWay) {
      spans.push_back({road[i].way - road[begin].way, told->metres, told->sigma});
    }
    begin = i;
  }
  return spans;
}

struct Sensor {
  const char* name;
  double shared;  ///< relative 1σ
  WayTeller tell;
};

std::vector<Sensor> sensors_of(const DriveRecord& drive, const DriveRecord* by_stereo,
                               const WayErrors& errors) {
  std::vector<Sensor> sensors;
  const VehicleReference& reference = drive.source.reference;
  const double lag = lag_of_gps(drive.vehicle_trajectory(), reference).value_or(0.0);
  sensors.push_back({"GPS speed", kGpsShared, [&reference, lag](double begin, double end) {
                       return way_by(reference.speeds, begin + lag, end + lag);
                     }});
  sensors.push_back({"wheels", errors.wheels, [&drive](double begin, double end) {
                       return way_by(drive.wheels, begin, end);
                     }});
  if (by_stereo == nullptr) return sensors;
  sensors.push_back(
      {"stereo", kStereoShared, [places = places_of(*by_stereo)](double begin, double end) {
         return way_by(places, begin, end);
       }});
  return sensors;
}

/// [m] of the log's sensor pose, where it is one above the road and contradicts; else 0.
double contradicting_mount(const DriveRecord& drive, const CameraHeight& height) {
  constexpr double kLowest = 0.5;         // [m] lower ones count from the vehicle
  constexpr double kContradiction = 3.0;  // [σ]
  const double mount = drive.T_vehicle_cam.translation().z();
  if (!height.is_known() || mount < kLowest) return 0.0;
  const double apart = std::abs(std::log(mount / height.metres));
  return apart > kContradiction * height.sigma ? mount : 0.0;
}

/// Why there is none although sensors told something.
std::string reason_of(const DriveRecord& drive, const CameraHeight& height, bool agreed) {
  if (!drive.setup_faults.empty()) {
    return "the drive speaks against camera and mount: " + drive.setup_faults.front();
  }
  if (height.sensors.empty()) {
    return "nothing in the log tells metres along twenty metres of straight road that images saw, "
           "too; a GPS with speeds, the odometry of wheels or stereo would";
  }
  if (!agreed) return "the sensors that tell metres contradict each other";
  return "it is good to " + fixed_text(100.0 * height.sigma, 0) +
         " % only, where lengths in metres need " + fixed_text(100.0 * kUseful, 0) +
         " %; drive longer on straight road, and bends for the focal length";
}

}  // namespace

CameraHeight camera_height_of(const DriveRecord& drive, const DriveRecord* by_stereo,
                              const WayErrors& errors, double focal_sigma) {
  CameraHeight height;
  height.assumed = drive.camera_height;
  const std::vector<Place> road = places_of(drive);
  std::vector<HeightMeasurement> told;
  for (const Sensor& sensor : sensors_of(drive, by_stereo, errors)) {
    auto measured = measure_height_by_ways(spans_of(road, sensor.tell));
    if (!measured) continue;
    measured->sigma = std::hypot(measured->sigma, sensor.shared);
    told.push_back(*measured);
    height.sensors.push_back({sensor.name, *measured});
  }
  const auto all = height_by_all(told);
  if (all) {
    height.length_sigma = std::hypot(all->sigma, errors.road);
    height.sigma = std::hypot(height.length_sigma, focal_sigma);
  }
  const bool known = all && drive.setup_faults.empty() && height.sigma <= kUseful;
  if (known) height.metres = drive.camera_height * all->ratio;
  height.by_log = contradicting_mount(drive, height);
  if (!known) height.reason = reason_of(drive, height, all.has_value());
  return height;
}

}  // namespace oneac::app
