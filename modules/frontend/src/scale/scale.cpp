#include "scale.h"

#include "depth_scale.h"
#include "room.h"
#include "stereo_travel.h"
#include "two_view/course.h"

#include "oneac/frontend/front_end_options.h"
#include "oneac/frontend/step_metres.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace oneac {
namespace {

// [m] A sensor pose lower than this has its origin on the vehicle, not on the road: then the log
// does not tell the camera's height.
constexpr double kLowestMount = 0.5;
// [-] Net way between two keyframes over the sum of its steps: less is no bend, but steps whose
// directions contradict each other, and a net way that says nothing of their lengths.
constexpr double kStraight = 0.7;
// Steps between two checks of a map that the road's corners hold.
constexpr int kCheckEvery = 5;

/// @pre the options are valid
LengthSource source_of_metres(const ScaleOptions& options) {
  if (options.source == "height") return LengthSource::kRoad;
  if (options.source == "stereo") return LengthSource::kStereo;
  const bool by_speed = options.source == "gps" || options.source == "wheels";
  return by_speed ? LengthSource::kSpeed : LengthSource::kNone;
}

}  // namespace

Scale::Scale(const FrontEndOptions& options)
    : metres_(source_of_metres(options.scale)),
      given_height_(options.camera_height),
      max_hold_(options.max_hold),
      max_uncertainty_(options.scale.max_uncertainty),
      least_depths_(static_cast<std::size_t>(options.window.min_carry)),
      filter_(options.scale),
      road_(options.ground_scale, options.consensus.threshold_px),
      one_speed_begins_(options.scale.source == "gps"),
      inertia_(options.scale, options.max_hold),
      road_uncertainty_(options.scale.road_uncertainty) {}

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
  carried_ = {};
  interval_ = {};
  conflicts_ = 0;
  needs_road_image_ = true;
  speeds_.restart(time_s);
}

std::vector<LengthMeasurement> Scale::measure(const TwoView& seen,
                                              const std::optional<LengthMeasurement>& carried,
                                              const Levelling& first,
                                              const Eigen::Vector3d& heading) const {
  if (carried) return {*carried};
  if (seen.status != StepStatus::kOk || !(camera_height() > 0.0)) return {};
  if (!goes_along(seen.pose.t, heading) || corners_may_slip()) return {};
  const auto road =
      road_.measure(affine_parts(seen.pair), seen.inliers, seen.pose, first, seen.focal_px);
  if (!road) return {};
  return {*road};
}

std::optional<MeasuredTravel> Scale::measure_directly(
    const RoadPair& road, const TwoView& seen, const std::optional<LengthMeasurement>& carried,
    const Levelling& first, const Eigen::Vector3d& heading, const StepInTime& step) {
  if (metres_ == LengthSource::kStereo) return stereo_travel(seen, heading, least_depths_);
  roll_sigma_ = first.roll_sigma;
  const bool resting = seen.status == StepStatus::kNoMotion;
  const bool in_use = metres_ == LengthSource::kRoad && camera_height() > 0.0;
  const StepLength by_map = carried ? stated(*carried) : StepLength{};
  const bool unsure = !by_map.metric || by_map.sigma > kSure * allowed_sigma(by_map.length);
  const auto expected = inertia_.expect(step.begin_s, step.end_s);
  // Inertia is judged by what does not know it, and so is one that nobody has confirmed for long.
  const bool surprises =
      (carried && (is_against(by_map, expected) || is_unlikely(by_map, expected))) ||
      held_ >= kPatience;
  const bool needed =
      unsure || surprises || needs_road_image_ || conflicts_ > 0 || stamps_are_wrong();
  const bool due = ++unchecked_ >= kCheckEvery;
  if (!resting && !(in_use && (needed || due))) return std::nullopt;
  if (seen.status == StepStatus::kPredicted) return std::nullopt;
  unchecked_ = 0;
  const RoadTravel told = road_travel(road, seen,
                                      {first, heading, surprises ? std::nullopt : expected,
                                       step.seconds(), in_use ? camera_height() : 0.0});
  return unless_it_repeats(told, expected && !surprises);
}

/// A length that was expected lies in a narrow range, which no rival is in. Others are not believed
/// of a road that a moment ago had two: a pattern is not always seen well enough to be one.
std::optional<MeasuredTravel> Scale::unless_it_repeats(const RoadTravel& told, bool predicted) {
  constexpr int kLooks = 5;
  if (told.repeats) road_repeats_ = kLooks;
  if (predicted || !told.travel || road_repeats_ == 0) return told.travel;
  --road_repeats_;
  return std::nullopt;
}

/// Corners of a pattern slip by its period as its grey values do; a map in metres tells them.
bool Scale::corners_may_slip() const {
  return road_repeats_ > 0 && !filter_.is_metric();
}

std::optional<ScaleCorrection> Scale::begin(const StepInTime& step,
                                            const LengthMeasurement& carried) {
  if (!std::isinf(filter_.uncertainty()) || !(carried.length > 0.0)) return std::nullopt;
  const StepLength told = by_itself(step);
  if (!chosen({told}, step).metric) return std::nullopt;
  ScaleCorrection correction;
  correction.factor =
      filter_.correct(told.length / carried.length, std::hypot(told.sigma, carried.sigma));
  interval_.rescale(correction.factor);
  carried_.rescale(correction.factor);
  return corrected(correction);
}

ScaleCorrection Scale::without_scale(ScaleCorrection correction) {
  filter_.lose();
  conflicts_ = kPatience;
  needs_road_image_ = true;
  interval_ = {};
  return corrected(correction);
}

ScaleCorrection Scale::corrected(ScaleCorrection correction) {
  speeds_.rescale(correction.factor);
  correction.sigma = std::hypot(filter_.uncertainty(), shared_doubt());
  correction.metric =
      filter_.is_metric() && is_sure(filter_.uncertainty(), shared_doubt(), max_uncertainty_);
  return correction;
}

StepLength Scale::length_of(const StepInTime& step,
                            const std::vector<LengthMeasurement>& measured) {
  const StepLength result = decided(step, measured);
  bool by_map = false;
  for (const LengthMeasurement& told : measured) {
    if (told.source != LengthSource::kMap) continue;
    carried_.add(told.length, told.sigma);
    by_map = true;
  }
  if (!by_map) carried_.add_untold(result.length);
  speeds_.add_step(step.end_s, result.length);
  if (result.source == LengthSource::kRoad) look_ahead(measured.front().reach);
  if (result.source == LengthSource::kRoadImage && step.direct) look_ahead(step.direct->reach);
  remember(step, result);
  return doubted_ ? without_metres(result) : with_doubt(result);
}

void Scale::look_ahead(double reach) {
  constexpr double kMemory = 0.2;  // the share of a measurement: a map rests on some five
  if (!(reach > 0.0) || metres_ != LengthSource::kRoad) return;
  reach2_ += (reach2_ > 0.0 ? kMemory : 1.0) * (reach * reach - reach2_);
}

/// A crest or sag has fallen or risen by d² / 2R at the distance d, and the height above the road
/// there is wrong by as much. `road_uncertainty` holds for the reach of usual cameras: 3 cm at 13 m
/// are a radius of 2.6 km, twice the least that design rules allow at 50 km/h.
double Scale::curve_doubt() const {
  constexpr double kUsualReach = 8.0;  // [heights]
  const double more = reach2_ / (kUsualReach * kUsualReach);
  return road_uncertainty_ * std::sqrt(std::max(more * more - 1.0, 0.0));
}

/// A road one height to the side, half a lane, is lower by the roll's error than it is taken for.
/// Straight ways do not show that error, and it stays for a drive.
double Scale::roll_doubt() const {
  return metres_ == LengthSource::kRoad ? roll_sigma_ : 0.0;
}

/// What the road's bumps and the springs add to lengths that a single stretch of it told, be it by
/// the speed that it told before; the map's filter has it already.
double Scale::road_doubt(LengthSource source) const {
  return metres_ == LengthSource::kRoad && source != LengthSource::kMap ? road_uncertainty_ : 0.0;
}

/// With what camera and road add to its σ: all lengths share it, so that nothing that compares two
/// of them has to know it.
StepLength Scale::with_doubt(StepLength length) const {
  const double doubt = std::hypot(shared_doubt(), road_doubt(length.source));
  if (!length.metric || !(length.length > 0.0) || !(doubt > 0.0)) return length;
  const bool sure = is_sure(length.sigma, doubt, max_uncertainty_);
  length.sigma = std::hypot(length.sigma, doubt);
  length.sigma_m = std::hypot(length.sigma_m, doubt * length.length);
  length.camera_doubt = camera_doubt();
  return sure ? length : without_metres(length);
}

void Scale::Carried::add(double length, double relative_sigma) {
  steps_ += 1.0;
  way_ += length;
  relative_ += relative_sigma * relative_sigma;
  absolute_ += relative_sigma * relative_sigma * length * length;
}

bool Scale::Carried::adds_up_to(double way) const {
  if (!(way_ > 0.0) || !(way > 0.0)) return true;
  // A bend may lose a tenth, and a chord is shorter than its arc.
  constexpr double kSame = 0.3;
  const double off = std::log((way_ + untold_) / way);
  return std::abs(off) <=
         kSame + kContradiction * std::sqrt(ScaleFilter::kStepsOfALandmark * variance());
}

double Scale::Carried::variance() const {
  if (!(way_ > 0.0)) return 0.0;
  constexpr double kEnds = 4.0;  // [σ of a step] of a way, for tracks that slip along with a patch
  if (steps_ <= ScaleFilter::kStepsOfALandmark) return relative_;
  return std::min(relative_, kEnds * kEnds * absolute_ / steps_ / (way_ * way_));
}

void Scale::remember(const StepInTime& step, const StepLength& length) {
  inertia_.tick(step.begin_s, step.end_s);
  if (length.beside_stamps) ++beside_stamps_;
  held_ = length.source == LengthSource::kHeld ? held_ + 1 : 0;
  if (step.status == StepStatus::kOk) moved_ = true;
  const bool measured = length.metric && length.source != LengthSource::kHeld;
  doubted_ = !measured && (doubted_ || length.refused);
  if (step.direct) conflicts_ = length.conflict ? conflicts_ + 1 : 0;
  weigh_inertia(length);
  if (measured && length.without_inertia) {
    const MeasuredTravel& told = *length.without_inertia;
    inertia_.tell(step.begin_s, step.end_s, told.length, told.sigma, common_sigma(told.source));
  } else if (measured && !length.beside_stamps) {
    inertia_.tell(step.begin_s, step.end_s, length.length, length.sigma_m,
                  common_sigma(length.source));
  }
  if (length.metric && !length.beside_stamps && step.seconds() > 0.0) {
    last_metric_speed_ = length.length / step.seconds();
    last_metric_time_ = step.end_s;
  }
  const StepLength direct = by_itself(step);
  // What inertia tells is no measurement of the map: it may rest on stamps that are wrong.
  const bool own =
      length.metric && length.source != LengthSource::kMap && length.source != LengthSource::kHeld;
  // Of a rest the noise is no way: it would add up.
  const bool rests = length.metric && length.source == LengthSource::kStanding;
  const StepLength& told = direct.metric && !rests ? direct : length;
  if (!direct.metric && !own) interval_.untold += told.length;
  interval_.way += told.length;
  interval_.used += length.length;
  if (direct.metric && step.direct->reach > 0.0) {
    interval_.seen += told.length;
    interval_.reached += step.direct->reach * step.direct->reach * told.length;
  }
  interval_.sigma_m += told.sigma_m;
}

double Scale::common_sigma(LengthSource source) const {
  return source == LengthSource::kMap && filter_.is_metric() ? filter_.uncertainty() : 0.0;
}

/// Inertia that nobody agrees with for too long had a wrong speed.
void Scale::weigh_inertia(const StepLength& length) {
  const bool agrees = length.source != LengthSource::kHeld || length.metric;
  if (agrees && !length.beside_stamps) {
    contradicted_ = 0;
  } else if (length.refused && ++contradicted_ >= kPatience) {
    inertia_.forget();
  }
}

ScaleCorrection Scale::correct(const MapLengths& map, const Levelling& first, double focal_px) {
  ScaleCorrection correction;
  const double way = map.newest.T_2_1.t.norm();
  const double turn = Eigen::AngleAxisd(map.newest.T_2_1.R).angle();
  const Carried carried = std::exchange(carried_, {});
  correction.share = filter_.drift(way, carried.variance(), turn);
  if (!carried.adds_up_to(way)) return without_scale(correction);
  for (const ScaleMeasurement& told : measure(map, first, focal_px)) {
    correction.factor *= filter_.correct(told.ratio, told.sigma);
    if (filter_.began_anew()) correction.share = 0.0;  // what is new says nothing of the past
    if (told.source == LengthSource::kRoad) correction.ground_acs = told.support;
    look_ahead(told.reach);
  }
  needs_road_image_ = metres_ == LengthSource::kRoad && correction.ground_acs == 0;
  interval_ = {};
  return corrected(correction);
}

std::vector<ScaleMeasurement> Scale::measure(const MapLengths& map, const Levelling& first,
                                             double focal_px) {
  std::optional<ScaleMeasurement> told;
  if (metres_ == LengthSource::kSpeed) told = by_speed();
  if (metres_ == LengthSource::kStereo) told = scale_by_depths(map.depths, least_depths_);
  if (metres_ == LengthSource::kRoad) told = by_road(map.newest, first, focal_px);
  const bool directly = metres_ == LengthSource::kRoad || metres_ == LengthSource::kStereo;
  const auto interval = directly ? by_interval(map.newest) : std::nullopt;
  // Corners of the bonnet or of traffic may look like a road; the grey values know better.
  const bool contradicted = told && interval && told->source == LengthSource::kRoad &&
                            std::abs(std::log(told->ratio / interval->ratio)) >
                                kContradiction * std::hypot(told->sigma, interval->sigma);
  if (contradicted) return {};
  if (!told) told = interval;
  if (!told) return {};
  return {*told};
}

std::optional<ScaleMeasurement> Scale::by_road(const KeyframePair& pair, const Levelling& first,
                                               double focal_px) const {
  const double in_map = pair.T_2_1.t.norm();
  if (!(in_map > 0.0) || corners_may_slip()) return std::nullopt;
  const std::vector<bool> all(pair.acs.size(), true);
  const auto road = road_.measure(pair.acs, all, pair.T_2_1, first, focal_px);
  if (!road) return std::nullopt;
  const double ratio = road->length / in_map;
  // Before anybody has measured it, the map's unit is a step. A creep by a few corners may be that
  // of a bonnet, or of tracks that slipped along a road which repeats.
  constexpr std::size_t kFew = 20;  // 2.5 times the least
  const bool creeps = std::isinf(filter_.uncertainty()) && ratio < kCreep;
  if (creeps && road->support < kFew) return std::nullopt;
  return ScaleMeasurement{ratio, road->sigma, road->source, road->support, road->reach};
}

std::optional<ScaleMeasurement> Scale::by_interval(const KeyframePair& pair) const {
  const double in_map = pair.T_2_1.t.norm();
  if (!interval_.is_told() || !(in_map > kStraight * interval_.used)) return std::nullopt;
  return ScaleMeasurement{
      interval_.way / in_map, std::max(interval_.sigma(), 1e-3),
      metres_ == LengthSource::kStereo ? LengthSource::kStereo : LengthSource::kRoadImage, 0,
      interval_.reach()};
}

std::optional<ScaleMeasurement> Scale::by_speed() {
  const auto over_an_epoch = speeds_.measure();
  const bool guess = !over_an_epoch && one_speed_begins_ && !filter_.is_metric();
  return guess ? speeds_.first_guess() : over_an_epoch;
}

}  // namespace oneac
