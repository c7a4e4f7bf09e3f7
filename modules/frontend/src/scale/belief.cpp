#include "scale.h"

#include "oneac/geometry/angles.h"
#include "oneac/geometry/angular_errors.h"
#include "oneac/geometry/vehicle_limits.h"

#include <algorithm>
#include <cmath>

// Which of those who tell the length of a step is believed: docs/decisions/lengths.md.
namespace oneac {
namespace {

// [m] 1σ of a short step that is as good as standing: what is far more than this in proportion to a
// creep of centimetres does not make the drive less certain.
constexpr double kSureWay = 0.01;
// [m] first step of a car that moves off, for want of better; the road corrects it.
constexpr double kFirstStep = 0.05;
// A camera at rest: the road moves by less than this [σ], and less than this [m].
constexpr double kMoves = 2.5;
// [σ] up to which two lengths of one step are the same.
constexpr double kAgree = 2.0;
constexpr double kStillness = 0.02;
constexpr double kNothing = 1e-9;  // [m] a shorter step is no divisor

// [m or heights] a rest that is known no better than this says nothing in metres.
constexpr double kSureRest = 0.05;
// [-] share of the points that has to rest: of a car that stood (a bus may fill the picture, and a
// tenth rests by chance), that drove, and of which nothing is known: half of them rest under
// clouds, and behind a bonnet nine tenths.
constexpr double kFew = 0.1, kMost = 0.5, kNearlyAll = 0.95;
// [rad] of a direction that is the car's, not that of somebody who crosses.
constexpr double kAlong = 15.0 * kDegree;

/// By how much two lengths disagree beyond their σ (Birge's ratio, not less than 1): their mean is
/// so much less sure.
double birge_ratio(const StepLength& a, const StepLength& b) {
  const double sigma = std::hypot(a.sigma_m, b.sigma_m);
  return sigma > 0.0 ? std::max(1.0, std::abs(a.length - b.length) / sigma) : 1.0;
}

/// Weighted mean, under the name of the surer; errors that the two share (the road's plane, the
/// height) do not average out, so it is no surer than the surer one.
StepLength mean_of(const StepLength& a, const StepLength& b) {
  StepLength result = a.sigma_m <= b.sigma_m ? a : b;
  const double wa = 1.0 / (a.sigma_m * a.sigma_m), wb = 1.0 / (b.sigma_m * b.sigma_m);
  if (!std::isfinite(wa) || !std::isfinite(wb) || !(wa + wb > 0.0)) return result;
  result.length = (wa * a.length + wb * b.length) / (wa + wb);
  result.sigma_m *= birge_ratio(a, b);
  if (result.length > 0.0) result.sigma = result.sigma_m / result.length;
  result.landmarks = std::max(a.landmarks, b.landmarks);
  result.ground_acs = std::max(a.ground_acs, b.ground_acs);
  return result;
}

/// Whether the car stood a moment ago.
bool speaks_for_rest(const ExpectedLength& expected) {
  return expected.length <= kStillness && expected.sigma <= kSureRest;
}

/// Of the points, so that a rest of them is one of the car.
double least_share_at_rest(bool speed_is_known, bool stood) {
  if (stood) return kFew;
  return speed_is_known ? kMost : kNearlyAll;
}

/// Whether two views show a way along wheels, and inertia does not speak for a rest: what rests
/// before the car may be a truck then that moves off as it does.
bool may_follow(const TwoView& seen, const Eigen::Vector3d& heading,
                const ExpectedLength& expected) {
  if (seen.kept_on_course || speaks_for_rest(expected)) return false;
  return direction_error(seen.pose.t, heading) < kAlong;
}

/// Whether a car of which this is expected may have come to rest.
bool could_stand(const std::optional<ExpectedLength>& expected) {
  return expected && expected->length <= kMoves * expected->sigma + kStillness;
}

}  // namespace

std::optional<MeasuredTravel> Scale::rest_by_road(const RoadPair& road, const TwoView& seen,
                                                  const Levelling& first,
                                                  const Eigen::Vector3d& heading,
                                                  const StepInTime& step) {
  const auto expected = inertia_.expect(step.begin_s, step.end_s);
  if (seen.status != StepStatus::kOk || !could_stand(expected)) return std::nullopt;
  if (step.through_dirt) return std::nullopt;
  if (may_follow(seen, heading, *expected)) return std::nullopt;
  TwoView rest;
  rest.status = StepStatus::kNoMotion;
  rest.focal_px = seen.focal_px;
  const auto told =
      road_travel(road, rest, {first, heading, expected, step.seconds(), camera_height()}).travel;
  if (!told || told->length > kMoves * told->sigma) return std::nullopt;
  unchecked_ = 0;
  return told;
}

bool Scale::contradict(const StepLength& a, const StepLength& b) {
  return std::abs(a.length - b.length) > kContradiction * std::hypot(a.sigma_m, b.sigma_m);
}

bool Scale::is_against(const StepLength& told, const std::optional<ExpectedLength>& expected) {
  return expected && std::isfinite(told.sigma_m) && !expected->allows(told.length, told.sigma_m);
}

bool Scale::is_unlikely(const StepLength& told, const std::optional<ExpectedLength>& expected) {
  return expected && std::abs(told.length - expected->length) >
                         kContradiction * std::hypot(expected->sigma, told.sigma_m);
}

/// Tracks slip along a road that repeats, and its landmarks with them: what is unlikely then needs
/// somebody else's word.
bool Scale::may_have_slipped(const StepLength& told, const StepInTime& step) const {
  return road_repeats_ > 0 && !step.direct && told.source == LengthSource::kMap &&
         is_unlikely(told, inertia_.expect(step.begin_s, step.end_s));
}

StepLength Scale::by_itself(const StepInTime& step) const {
  StepLength told;
  if (!step.direct || !step.direct->in_metres || !(step.direct->length > 0.0)) return told;
  told.length = step.direct->length;
  told.sigma_m = step.direct->sigma;
  told.sigma = step.direct->sigma / step.direct->length;
  told.metric = true;
  told.source = step.direct->source;
  return may_be_the_car(told, step) ? without_metres(told) : told;
}

/// While no speed is known, a bonnet that rests is a creeping car, by noise.
bool Scale::may_be_the_car(const StepLength& told, const StepInTime& step) const {
  if (step.car_is_known || told.source == LengthSource::kMap) return false;
  return told.length < kCreep && !inertia_.expect(step.begin_s, step.end_s);
}

StepLength Scale::decided(const StepInTime& step,
                          const std::vector<LengthMeasurement>& measured) const {
  if (step.status == StepStatus::kNoMotion) return at_rest(step);
  std::vector<StepLength> told;
  if (!measured.empty()) {
    const StepLength by_map = stated(measured.front());
    const bool sound = !may_be_the_car(by_map, step) && !may_have_slipped(by_map, step);
    if (sound) told.push_back(by_map);
  }
  if (const StepLength direct = by_itself(step); direct.metric) told.push_back(direct);
  StepLength result = chosen(told, step);
  // A map that is too unsure to be called metric knows what cannot be.
  if (result.metric && told.size() == 2 && !told.front().metric &&
      contradict(told.front(), result)) {
    result = without_metres(result);
    result.conflict = result.refused = true;
  }
  if (result.metric) return result;
  // A map that is too unsure to be called metric still knows better than inertia does after a
  // while, and its landmarks and its poses stay of one scale.
  const auto expected = inertia_.expect(step.begin_s, step.end_s);
  const bool unsure_map = !result.refused && !told.empty() && !filter_.is_metric() &&
                          told.front().source == LengthSource::kMap;
  if (unsure_map && (!expected || told.front().sigma_m < expected->sigma)) {
    StepLength unscaled = told.front();
    unscaled.sigma = unscaled.sigma_m = 0.0;
    return unscaled;
  }
  StepLength goes_on = held(step);
  // Images and speed together were too unsure: the speed alone is no surer.
  if (result.without_inertia) goes_on = without_metres(goes_on);
  goes_on.conflict = result.conflict;
  goes_on.refused = result.refused || (unsure_map && is_against(told.front(), expected));
  goes_on.too_fast = result.too_fast;
  if (!told.empty()) goes_on.ground_acs = told.front().ground_acs;
  return goes_on;
}

/// Of those who tell metres what inertia allows, together; not metric when nobody is believed.
StepLength Scale::chosen(const std::vector<StepLength>& told, const StepInTime& step) const {
  const auto expected = inertia_.expect(step.begin_s, step.end_s);
  std::vector<StepLength> believed, refused_by_inertia;
  StepLength refused;
  for (const StepLength& length : told) {
    if (!length.metric) continue;
    const bool slow =
        !(step.seconds() > 0.0) || !(length.length > VehicleLimits::kFastest * step.seconds());
    if (slow && (!expected || expected->allows(length.length, length.sigma_m))) {
      believed.push_back(length);
    } else {
      if (slow) refused_by_inertia.push_back(length);
      refused.refused = true;
      refused.too_fast = refused.too_fast || !slow;
      refused.conflict = refused.conflict || length.source == LengthSource::kMap;
    }
  }
  StepLength result = refused;
  if (believed.size() == 1) result = believed.front();
  if (believed.size() > 1) {
    result = together(believed[0], believed[1], stamps_are_wrong() ? std::nullopt : expected);
  }
  result.refused = refused.refused;
  result.too_fast = refused.too_fast;
  result.conflict = result.conflict || refused.conflict;
  if (const auto agreed = against_inertia(refused_by_inertia)) return *agreed;
  if (!result.metric) return result;
  if (expected) result = steadied(result, *expected);
  result.metric = result.sigma <= allowed_sigma(result.length);
  return result;
}

/// Map and road, who do not know each other, say the same of a step that inertia does not allow:
/// then it is its stamps that are wrong, as where images were dropped under a fixed rate.
std::optional<StepLength> Scale::against_inertia(const std::vector<StepLength>& refused) const {
  if (refused.size() < 2) return std::nullopt;
  const StepLength &a = refused[0], &b = refused[1];
  const bool both_go = std::min(a.length, b.length) > kStillness;
  const bool sure = std::max(a.sigma, b.sigma) <= max_uncertainty_;
  const bool agree = std::abs(a.length - b.length) <= kAgree * std::hypot(a.sigma_m, b.sigma_m);
  if (!both_go || !sure || !agree) return std::nullopt;
  StepLength agreed = mean_of(a, b);
  agreed.refused = agreed.beside_stamps = true;
  return agreed;
}

/// Two of one step: a sure first one, else their mean, or when they contradict each other the less
/// surprising one.
StepLength Scale::together(const StepLength& a, const StepLength& b,
                           const std::optional<ExpectedLength>& expected) const {
  if (!contradict(a, b)) {
    return a.sigma <= kSure * allowed_sigma(a.length) ? a : mean_of(a, b);
  }
  StepLength result = a;
  if (expected) {
    const auto surprise = [&](const StepLength& length) {
      return std::abs(length.length - expected->length) /
             std::hypot(expected->sigma, length.sigma_m);
    };
    if (surprise(b) < surprise(a)) result = b;
  } else {
    result.metric = false;  // one of the two is wrong, and nothing tells which
  }
  result.conflict = true;
  return result;
}

/// An unsure length, helped by inertia: far landmarks know little of a short step.
StepLength Scale::steadied(const StepLength& told, const ExpectedLength& expected) const {
  if (told.sigma <= kSure * allowed_sigma(told.length) || stamps_are_wrong()) return told;
  StepLength inertia;
  inertia.length = expected.length;
  inertia.sigma_m = expected.sigma;
  if (std::abs(told.length - inertia.length) >
      kContradiction * std::hypot(told.sigma_m, inertia.sigma_m)) {
    return told;
  }
  StepLength result = told;
  result.without_inertia = MeasuredTravel{told.length, told.sigma_m, told.source, true};
  result.length = mean_of(told, inertia).length;
  result.sigma_m = told.sigma_m * inertia.sigma_m / std::hypot(told.sigma_m, inertia.sigma_m);
  result.sigma_m *= birge_ratio(told, inertia);
  // The speed may have been learned from lengths of the same map.
  const double shared = common_sigma(told.source) * told.length;
  result.sigma_m = std::max(result.sigma_m, std::min(shared, expected.common));
  result.sigma = result.sigma_m / std::max(result.length, kNothing);
  return result;
}

StepLength Scale::held(const StepInTime& step) const {
  StepLength result;
  result.length = held_length(step);
  result.source = LengthSource::kHeld;
  const auto expected = inertia_.expect(step.begin_s, step.end_s);
  if (!expected || !(expected->length > 0.0)) return result;
  result.length = expected->length;
  const double sigma_m = std::max(expected->sigma, expected->common);
  const double sigma = sigma_m / expected->length;
  // A step that the images did not carry has no rotation of its own either.
  const bool seen = step.status == StepStatus::kOk;
  result.metric = seen && contradicted_ == 0 && sigma <= max_uncertainty_ && !stamps_are_wrong();
  if (!result.metric) return result;
  result.sigma = sigma;
  result.sigma_m = sigma_m;
  return result;
}

StepLength Scale::at_rest(const StepInTime& step) const {
  if (step.repeated) return {};  // of the image, not of the car
  const auto expected = inertia_.expect(step.begin_s, step.end_s);
  if (!expected && step.shows_travel) return held(step);
  if (step.through_dirt) return without_metres(held(step));
  StepLength result;
  result.source = LengthSource::kStanding;
  // While no speed is known, a bonnet rests as a road at rest does: before anything has moved it
  // takes a while of rest to know, afterwards that the car's own parts are known.
  const bool unknown = !expected && !(moved_ ? step.car_is_known : step.began_at_rest);
  // Unless the car stood a moment ago most of the picture has to rest: a few points do by chance,
  // like the edges of the blocks of a compressed picture.
  const bool stood = expected && speaks_for_rest(*expected);
  const bool few_rest = step.resting < least_share_at_rest(expected.has_value(), stood);
  if (const auto& told = step.direct) {
    const bool moves = told->length > std::max(kStillness, kMoves * told->sigma);
    if (moves && told->in_metres) {
      const StepLength direct = by_itself(step);
      // A creep is seen as a rest is, by what nearly keeps its place, and asks for as much.
      if (!expected) return few_rest || !direct.metric ? held(step) : direct;
      return expected->allows(direct.length, direct.sigma_m) ? direct : held(step);
    }
    // Of a car that was too fast to be there already what rests is something else.
    const bool too_soon = expected && !could_stand(expected);
    result.metric = !moves && told->sigma <= kSureRest && !unknown && !few_rest && !too_soon;
    result.sigma_m = std::hypot(told->sigma, told->length);  // what it may have crept
    return result;
  }
  if (expected && expected->least > kStillness) return held(step);
  // Nobody saw the road: zero is believed of a car that was nearly there, for a moment. Without a
  // speed even identical images are no rest: a truck that fills them goes as we do. Nor does the
  // speed learn from it: it would confirm itself for as long as the truck is there.
  result.source = LengthSource::kHeld;
  result.metric = could_stand(expected) && expected->sigma <= kSureRest && !few_rest;
  if (result.metric) result.sigma_m = expected->sigma;
  return result;
}

double Scale::allowed_sigma(double length) const {
  return std::max(max_uncertainty_, kSureWay / std::max(length, kNothing));
}

StepLength Scale::stated(const LengthMeasurement& measured) const {
  StepLength result;
  result.length = measured.length;
  result.source = measured.source;
  if (measured.source == LengthSource::kMap) {
    const double turn = measured.turn_sigma / std::max(measured.length, 1e-9);
    result.sigma = std::hypot(std::hypot(measured.sigma, turn), filter_.uncertainty());
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

}  // namespace oneac
