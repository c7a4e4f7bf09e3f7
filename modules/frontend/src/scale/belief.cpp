#include "scale.h"

#include <algorithm>
#include <cmath>

// Which of those who tell the length of a step is believed: docs/decisions/lengths.md.
namespace oneac {
namespace {

// [m/s] Plausible speeds of a car, 250 km/h; a length beyond is refused as metric.
constexpr double kFastestCar = 70.0;
// [m] 1σ of a short step that is as good as standing: what is far more than this in proportion to a
// creep of centimetres does not make the drive less certain.
constexpr double kSureWay = 0.01;
// [m] first step of a car that moves off, for want of better; the road corrects it.
constexpr double kFirstStep = 0.05;
// A camera at rest: the road moves by less than this [σ], and less than this [m].
constexpr double kMoves = 2.5;
constexpr double kStillness = 0.02;
// [m or heights] a rest that is known no better than this says nothing in metres.
constexpr double kSureRest = 0.05;

}  // namespace

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
  goes_on.refused = result.refused;
  if (!told.empty()) goes_on.ground_acs = told.front().ground_acs;
  return goes_on;
}

/// Of those who tell metres the first that inertia allows; not metric when nobody is believed.
StepLength Scale::chosen(const std::vector<StepLength>& told, const StepInTime& step) const {
  const auto expected = inertia_.expect(step.begin_s, step.end_s);
  std::vector<StepLength> believed;
  StepLength result;
  for (const StepLength& length : told) {
    const bool slow = !(step.seconds() > 0.0) || !(length.length > kFastestCar * step.seconds());
    const bool possible = slow && (!expected || expected->allows(length.length, length.sigma_m));
    if (length.metric && possible) believed.push_back(length);
    if (!length.metric || possible) continue;
    result.refused = true;
    if (length.source == LengthSource::kMap) result.conflict = true;
  }
  const bool conflict = result.conflict, refused = result.refused;
  if (!believed.empty()) result = believed.front();
  result.conflict = conflict;
  result.refused = refused;
  if (believed.size() < 2) return result;
  const double off = std::abs(believed[0].length - believed[1].length);
  if (off <= kContradiction * std::hypot(believed[0].sigma_m, believed[1].sigma_m)) return result;
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
    result.sigma_m = std::hypot(told->sigma, told->length);  // what it may have crept
    return result;
  }
  if (expected && expected->least > kStillness) return held(step);
  // Nobody saw the road: zero is believed of a car that was nearly there.
  const bool could_stand = expected && expected->length <= kMoves * expected->sigma + kStillness;
  // Without a speed even identical images are no rest: a truck that fills them goes as we do.
  result.metric = could_stand;
  if (result.metric) result.sigma_m = expected->sigma;
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

}  // namespace oneac
