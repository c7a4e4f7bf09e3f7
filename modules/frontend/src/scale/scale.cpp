#include "scale.h"

#include "depth_scale.h"

#include "oneac/frontend/front_end_options.h"

#include <cmath>
#include <utility>

namespace oneac {
namespace {

// [m] A sensor pose lower than this has its origin on the vehicle, not on the road: then the log
// does not tell the camera's height.
constexpr double kLowestMount = 0.5;
// [m/s] Plausible speeds of a car, 250 km/h; a length beyond is refused as metric.
constexpr double kFastestCar = 70.0;
// [m] first step of a car that moves off, for want of better; the road corrects it.
constexpr double kFirstStep = 0.05;
// Steps between two checks of a map that the road's corners hold.
constexpr int kCheckEvery = 5;
// [σ] Two lengths of one step that are farther apart contradict each other.
constexpr double kAgree = 4.0;
// A camera at rest: the road moves by less than this [σ], and less than this [m].
constexpr double kMoves = 2.5;
constexpr double kStillness = 0.02;
// [m or heights] a rest that is known no better than this says nothing in metres.
constexpr double kSureRest = 0.05;

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
      least_depths_(static_cast<std::size_t>(options.window.min_carry)),
      filter_(options.scale),
      road_(options.ground_scale, options.consensus.threshold_px),
      max_uncertainty_(options.scale.max_uncertainty),
      inertia_(options.scale, options.max_hold) {}

void Scale::start(const CameraFrame& first) {
  speeds_.restart(first.time_s);
  if (metres_ != LengthSource::kRoad) return;
  const double mount_height = first.T_vehicle_cam.translation().z();
  const bool from_mount = given_height_ == 0.0 && mount_height >= kLowestMount;
  road_.set_camera_height(from_mount ? mount_height : given_height_);
}

void Scale::add_speed(double time_s, double speed_mps) {
  speeds_.add_speed(time_s, speed_mps);
}

void Scale::restart(double time_s) {
  filter_.lose();
  carried_variance_ = 0.0;
  interval_ = {};
  conflicts_ = 0;
  needs_road_image_ = true;
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

std::optional<RoadTravel> Scale::along_road(const RoadPair& road, const TwoView& seen,
                                            const std::optional<LengthMeasurement>& carried,
                                            const Levelling& first, const Eigen::Vector3d& heading,
                                            const StepInTime& step) {
  const bool resting = seen.status == StepStatus::kNoMotion;
  const bool in_use = metres_ == LengthSource::kRoad && camera_height() > 0.0;
  const bool needed = !carried || !filter_.is_metric() || needs_road_image_ || conflicts_ > 0;
  const bool due = ++unchecked_ >= kCheckEvery;
  if (!resting && !(in_use && (needed || due))) return std::nullopt;
  if (seen.status == StepStatus::kPredicted) return std::nullopt;
  unchecked_ = 0;
  return road_travel(road, seen,
                     {first, heading, expected(step.begin_s, step.end_s), step.seconds(),
                      in_use ? camera_height() : 0.0});
}

StepLength Scale::length_of(const StepInTime& step,
                            const std::vector<LengthMeasurement>& measured) {
  const StepLength result = decided(step, measured);
  for (const LengthMeasurement& told : measured) {
    if (told.source == LengthSource::kMap) carried_variance_ += told.sigma * told.sigma;
  }
  speeds_.add_step(step.end_s, result.length);
  remember(step, result);
  return result;
}

void Scale::remember(const StepInTime& step, const StepLength& length) {
  const bool measured = length.metric && length.source != LengthSource::kHeld;
  if (step.road) conflicts_ = length.conflict ? conflicts_ + 1 : 0;
  if (length.source != LengthSource::kHeld || length.metric)
    contradicted_ = 0;
  else if (inertia_.expect(step.begin_s, step.end_s) && ++contradicted_ >= kPatience)
    inertia_.forget();
  if (measured) inertia_.tell(step.begin_s, step.end_s, length.length, length.sigma_m);
  if (length.metric && step.seconds() > 0.0) {
    last_metric_speed_ = length.length / step.seconds();
    last_metric_time_ = step.end_s;
  }
  const StepLength road = by_road_image(step);
  const bool own = length.metric && length.source != LengthSource::kMap;
  const StepLength& told = road.metric ? road : length;
  interval_.whole = interval_.whole && (road.metric || own);
  interval_.way += told.length;
  if (told.length > 0.0) interval_.relative_sigma = std::max(interval_.relative_sigma, told.sigma);
}

StepLength Scale::by_road_image(const StepInTime& step) const {
  StepLength told;
  if (!step.road || !(camera_height() > 0.0) || !(step.road->length > 0.0)) return told;
  told.length = step.road->length;
  told.sigma_m = step.road->sigma;
  told.sigma = step.road->sigma / step.road->length;
  told.metric = true;
  told.source = LengthSource::kRoadImage;
  return told;
}

StepLength Scale::decided(const StepInTime& step,
                          const std::vector<LengthMeasurement>& measured) const {
  if (step.status == StepStatus::kNoMotion) return at_rest(step);
  std::vector<StepLength> told;
  if (!measured.empty()) told.push_back(stated(measured.front()));
  if (const StepLength road = by_road_image(step); road.metric) told.push_back(road);
  const StepLength result = chosen(told, step);
  if (result.metric) return result;
  // The unit of a map without scale goes on while nobody knows a speed in metres.
  const bool unscaled_map =
      !told.empty() && told.front().source == LengthSource::kMap && !filter_.is_metric();
  if (unscaled_map && !inertia_.expect(step.begin_s, step.end_s)) {
    StepLength unscaled = told.front();
    unscaled.sigma = unscaled.sigma_m = 0.0;
    return unscaled;
  }
  StepLength goes_on = held(step);
  goes_on.conflict = result.conflict;
  if (!told.empty()) goes_on.ground_acs = told.front().ground_acs;
  return goes_on;
}

/// Of those who tell metres the first that inertia allows; not metric when nobody is believed.
StepLength Scale::chosen(const std::vector<StepLength>& told, const StepInTime& step) const {
  const auto expected = inertia_.expect(step.begin_s, step.end_s);
  std::vector<StepLength> believed;
  bool map_refused = false;
  for (const StepLength& length : told) {
    const bool slow = !(step.seconds() > 0.0) || !(length.length > kFastestCar * step.seconds());
    const bool possible = slow && (!expected || expected->allows(length.length, length.sigma_m));
    if (length.metric && possible) believed.push_back(length);
    if (length.metric && !possible && length.source == LengthSource::kMap) map_refused = true;
  }
  StepLength result;
  if (!believed.empty()) result = believed.front();
  result.conflict = map_refused;
  if (believed.size() < 2) return result;
  const double off = std::abs(believed[0].length - believed[1].length);
  if (off <= kAgree * std::hypot(believed[0].sigma_m, believed[1].sigma_m)) return result;
  result.conflict = true;
  if (!expected) {
    result.metric = false;  // one of the two is wrong, and nothing tells which
    return result;
  }
  const auto surprise = [&](const StepLength& length) {
    return std::abs(length.length - expected->length) / std::hypot(expected->sigma, length.sigma_m);
  };
  if (surprise(believed[1]) < surprise(believed[0])) result = believed[1];
  result.conflict = true;
  return result;
}

StepLength Scale::held(const StepInTime& step) const {
  StepLength result;
  result.length = held_length(step);
  result.source = LengthSource::kHeld;
  const auto expected = inertia_.expect(step.begin_s, step.end_s);
  if (!expected || !(expected->length > 0.0)) return result;
  result.length = expected->length;
  const double sigma = expected->sigma / expected->length;
  // A step that the images did not carry has no rotation of its own either.
  const bool seen = step.status == StepStatus::kOk;
  result.metric = seen && contradicted_ == 0 && sigma <= max_uncertainty_;
  if (!result.metric) return result;
  result.sigma = sigma;
  result.sigma_m = expected->sigma;
  return result;
}

StepLength Scale::at_rest(const StepInTime& step) const {
  const auto expected = inertia_.expect(step.begin_s, step.end_s);
  StepLength result;
  result.source = LengthSource::kStanding;
  std::optional<RoadTravel> told = step.road;
  if (!told && step.evidence) told = step.evidence;
  if (told) {
    const bool moves = told->length > std::max(kStillness, kMoves * told->sigma) && step.road;
    if (moves && camera_height() > 0.0) {
      const StepLength road = by_road_image(step);
      if (!expected || expected->allows(road.length, road.sigma_m)) return road;
      return held(step);
    }
    result.metric = !moves && told->sigma <= kSureRest;
    result.sigma_m = told->sigma;
    return result;
  }
  if (expected && expected->least > kStillness) return held(step);
  // Nobody saw the road: zero is believed of a car that was nearly there.
  const bool could_stand = expected && expected->length <= kMoves * expected->sigma + kStillness;
  result.metric = could_stand || (step.near_identical && !expected);
  if (result.metric) result.sigma_m = expected ? expected->sigma : kStillness;
  return result;
}

StepLength Scale::stated(const LengthMeasurement& measured) const {
  StepLength result;
  result.length = measured.length;
  result.source = measured.source;
  if (measured.source == LengthSource::kMap) {
    result.sigma = std::hypot(measured.sigma, filter_.uncertainty());
    result.metric = filter_.is_metric();
    result.landmarks = measured.support;
  } else {
    result.sigma = measured.sigma;
    result.metric = true;
    result.ground_acs = measured.support;
  }
  result.sigma_m = result.length * result.sigma;
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
    if (filter_.began_anew()) correction.share = 0.0;  // what is new says nothing of the past
    if (told.source == LengthSource::kRoad) correction.ground_acs = told.support;
  }
  needs_road_image_ = metres_ == LengthSource::kRoad && correction.ground_acs == 0;
  interval_ = {};
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
  const auto interval = metres_ == LengthSource::kRoad ? by_interval(map.newest) : std::nullopt;
  // Corners of the bonnet or of traffic may look like a road; the grey values know better.
  const bool contradicted = told && interval && told->source == LengthSource::kRoad &&
                            std::abs(std::log(told->ratio / interval->ratio)) >
                                kAgree * std::hypot(told->sigma, interval->sigma);
  if (contradicted) return {};
  if (!told) told = interval;
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

std::optional<ScaleMeasurement> Scale::by_interval(const KeyframePair& pair) const {
  const double in_map = pair.T_2_1.t.norm();
  if (!interval_.whole || !(interval_.way > 0.0) || !(in_map > 0.0)) return std::nullopt;
  return ScaleMeasurement{interval_.way / in_map, std::max(interval_.relative_sigma, 1e-3),
                          LengthSource::kRoadImage, 0};
}

std::optional<ScaleMeasurement> Scale::by_speed() {
  const auto over_an_epoch = speeds_.measure();
  return over_an_epoch || filter_.is_metric() ? over_an_epoch : speeds_.first_guess();
}

}  // namespace oneac
