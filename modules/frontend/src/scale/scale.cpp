#include "scale.h"

#include "depth_scale.h"

#include "oneac/frontend/front_end_options.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oneac {
namespace {

// [m] A sensor pose lower than this has its origin on the vehicle, not on the road: then the log
// does not tell the camera's height.
constexpr double kLowestMount = 0.5;
// [m/s] Plausible speeds of a car, 250 km/h; a length beyond is refused as metric.
constexpr double kFastestCar = 70.0;
// [m] 1σ of a short step that is as good as standing: what is far more than this in proportion to a
// creep of centimetres does not make the drive less certain.
constexpr double kSureWay = 0.01;
// [m] first step of a car that moves off, for want of better; the road corrects it.
constexpr double kFirstStep = 0.05;

/// @pre the options are valid
LengthSource source_of_metres(const ScaleOptions& options) {
  if (options.source == "height") return LengthSource::kRoad;
  if (options.source == "stereo") return LengthSource::kStereo;
  return options.source == "gps" ? LengthSource::kSpeed : LengthSource::kNone;
}

}  // namespace

Scale::Scale(const FrontEndOptions& options)
    : metres_(source_of_metres(options.scale)),
      given_height_(options.camera_height),
      max_hold_(options.max_hold),
      max_uncertainty_(options.scale.max_uncertainty),
      least_depths_(static_cast<std::size_t>(options.window.min_carry)),
      filter_(options.scale),
      road_(options.ground_scale, options.consensus.threshold_px) {}

void Scale::start(const CameraFrame& first) {
  speeds_.restart(first.time_s);
  if (metres_ != LengthSource::kRoad) return;
  const double mount_height = first.T_vehicle_cam.translation().z();
  const bool from_mount = given_height_ == 0.0 && mount_height >= kLowestMount;
  road_.set_camera_height(from_mount ? mount_height : given_height_);
}

void Scale::add_speed(const SpeedReading& told) {
  speeds_.add_speed(told);
}

void Scale::restart(double time_s) {
  filter_.lose();
  carried_variance_ = 0.0;
  speeds_.restart(time_s);
}

std::vector<LengthMeasurement> Scale::measure(const TwoView& seen,
                                              const std::optional<LengthMeasurement>& carried,
                                              const Levelling& first) const {
  if (carried) return {*carried};
  if (seen.status != StepStatus::kOk || !(camera_height() > 0.0)) return {};
  const auto road =
      road_.measure(affine_parts(seen.pair), seen.inliers, seen.pose, first, seen.focal_px);
  if (!road) return {};
  return {*road};
}

StepLength Scale::length_of(const StepInTime& step,
                            const std::vector<LengthMeasurement>& measured) {
  const StepLength result = decided(step, measured);
  for (const LengthMeasurement& told : measured) {
    if (told.source == LengthSource::kMap) carried_variance_ += told.sigma * told.sigma;
  }
  speeds_.add_step(step.end_s, result.length);
  if (result.metric && step.seconds() > 0.0) {
    last_metric_speed_ = result.length / step.seconds();
    last_metric_time_ = step.end_s;
  }
  return result;
}

StepLength Scale::decided(const StepInTime& step,
                          const std::vector<LengthMeasurement>& measured) const {
  StepLength result;
  if (step.status == StepStatus::kNoMotion) {
    result.metric = true;  // zero metres
    result.source = LengthSource::kStanding;
    return result;
  }
  if (!measured.empty()) result = stated(measured.front());
  const double seconds = step.seconds();
  const bool possible = !(seconds > 0.0) || !(result.length > kFastestCar * seconds);
  result.metric = result.metric && possible;
  if (result.metric) return result;
  result.sigma = 0.0;
  if (result.source == LengthSource::kMap) return result;
  result.length = held_length(step);
  result.source = LengthSource::kHeld;
  return result;
}

double Scale::allowed_sigma(double length) const {
  return std::max(max_uncertainty_, kSureWay / std::max(length, kSureWay));
}

StepLength Scale::stated(const LengthMeasurement& measured) const {
  StepLength result;
  result.length = measured.length;
  result.source = measured.source;
  if (measured.source == LengthSource::kMap) {
    result.sigma = std::hypot(measured.sigma, filter_.uncertainty());
    result.metric = filter_.is_metric() && result.sigma <= allowed_sigma(result.length);
    result.landmarks = measured.support;
  } else {
    result.sigma = measured.sigma;
    result.metric = true;
    result.ground_acs = measured.support;
  }
  return result;
}

double Scale::held_length(const StepInTime& step) const {
  const double before = step.expected.t.norm();
  if (before == 0.0 && last_metric_time_ == 0.0) return 1.0;  // the unit of the map
  const bool too_old = step.end_s - last_metric_time_ > max_hold_ || !(step.seconds() > 0.0);
  const double held = too_old ? before : last_metric_speed_ * step.seconds();
  // A map that begins with a car moving off needs some length to measure the road in.
  const bool begins = std::isinf(filter_.uncertainty()) && held < kFirstStep;
  return begins && step.status == StepStatus::kOk ? kFirstStep : held;
}

ScaleCorrection Scale::correct(const MapLengths& map, const Levelling& first, double focal_px) {
  ScaleCorrection correction;
  const double way = map.newest.T_2_1.t.norm();
  correction.share = filter_.drift(way, std::exchange(carried_variance_, 0.0));
  for (const ScaleMeasurement& told : measure(map, first, focal_px)) {
    correction.factor *= filter_.correct(told.ratio, told.sigma);
    if (told.source == LengthSource::kRoad) correction.ground_acs = told.support;
  }
  speeds_.rescale(correction.factor);
  correction.metric = filter_.is_metric();
  correction.sigma = filter_.uncertainty();
  return correction;
}

std::vector<ScaleMeasurement> Scale::measure(const MapLengths& map, const Levelling& first,
                                             double focal_px) {
  std::optional<ScaleMeasurement> told;
  if (metres_ == LengthSource::kSpeed) told = by_speed();
  if (metres_ == LengthSource::kStereo) told = scale_by_depths(map.depths, least_depths_);
  if (metres_ == LengthSource::kRoad) told = by_road(map.newest, first, focal_px);
  if (!told) return {};
  return {*told};
}

std::optional<ScaleMeasurement> Scale::by_road(const KeyframePair& pair, const Levelling& first,
                                               double focal_px) const {
  const double in_map = pair.T_2_1.t.norm();
  if (!(in_map > 0.0)) return std::nullopt;
  const std::vector<bool> all(pair.acs.size(), true);
  const auto road = road_.measure(pair.acs, all, pair.T_2_1, first, focal_px);
  if (!road) return std::nullopt;
  return ScaleMeasurement{road->length / in_map, road->sigma, road->source, road->support};
}

std::optional<ScaleMeasurement> Scale::by_speed() {
  const auto over_an_epoch = speeds_.measure();
  return over_an_epoch || filter_.is_metric() ? over_an_epoch : speeds_.first_guess();
}

}  // namespace oneac
