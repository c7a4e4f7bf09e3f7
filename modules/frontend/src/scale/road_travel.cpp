#include "road_travel.h"

#include "attitude/mainly_forward.h"
#include "scale/room.h"
#include "two_view/below_the_sky.h"
#include "two_view/course.h"

#include "oneac/geometry/levelling.h"
#include "oneac/geometry/vehicle_limits.h"

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

// [m] where the height is not known, speeds are bounded as if it were this.
constexpr double kUsualHeight = 1.5;
constexpr double kLeastHeights = 0.05;  // [heights] room for the search at a standstill
// Where two views did not say how sure they are [rad]: rotation, direction.
constexpr double kUntoldTurnSigma = 0.001, kTravelSigma = 0.02;
// [rad] 1σ of a direction that was taken from the step before.
constexpr double kHeadingSigma = 0.04;
constexpr double kLeastExpectedSigma = 0.03;  // [heights]
// [heights] Two views that saw a translation saw more than this, unless the car creeps: then what
// keeps its place in the picture is the bonnet, or dirt, and no road.
constexpr double kBeyond = 3.0;  // [σ]
// [heights] what keeps its place on glass and sensor pulls a length of less than a pixel.
constexpr double kLeastSigma = 0.003;
constexpr double kMoving = 0.05;
constexpr double kSurely = 2.0;  // [σ] of inertia that says so

double rms(const Eigen::Matrix3d& covariance, double unknown) {
  const double variance = covariance.trace() / 3.0;
  return variance > 0.0 && std::isfinite(variance) ? std::sqrt(variance) : unknown;
}

/// What inertia allows, in camera heights.
void expect(const RoadTravelPrior& prior, double height, bool moves, RoadStep& step) {
  const double fastest = std::max(kLeastHeights, VehicleLimits::kFastest * prior.seconds / height);
  step.max_length = std::min(fastest, 20.0);
  const bool creeps = prior.expected &&
                      prior.expected->length + kSurely * prior.expected->sigma < kCreeping * height;
  if (moves && !creeps) step.min_length = std::min(kMoving, step.max_length);
  if (!prior.expected) return;
  step.length = prior.expected->length / height;
  step.length_sigma = std::max(prior.expected->sigma / height, kLeastExpectedSigma);
  step.min_length = std::clamp(prior.expected->least / height, step.min_length, step.max_length);
  step.max_length =
      std::clamp(prior.expected->most / height + kLeastHeights, step.min_length, step.max_length);
}

/// Whether the direction is one that wheels take, as far as level, springs and images are known:
/// one that rises by 3° makes the road's length wrong by a quarter.
bool lies_in_the_road(const RoadStep& step, double direction_sigma) {
  const Eigen::Vector3d along = step.T_2_1.R.transpose() * step.T_2_1.t.normalized();
  const double elevation = std::asin(std::clamp(step.R_level_cam.row(1).dot(along), -1.0, 1.0));
  const double springs = RoadAlignmentOptions().heave / std::max(step.length, kMoving);
  const double level = std::hypot(step.pitch_sigma, direction_sigma);
  return std::abs(elevation) <= kBeyond * std::hypot(level, springs);
}

/// What a camera that looks aside sees beyond a lane is no road: kerb, parked cars, house fronts.
/// It rests when the car does, but how fast it passes says nothing.
bool looks_aside(const RoadStep& step) {
  const Eigen::Vector3d along = step.T_2_1.R.transpose() * step.T_2_1.t.normalized();
  return std::abs(step.R_level_cam.row(2).dot(along)) < kMainlyForward;
}

/// [lengths of the step]
double room_beside(const TwoView& seen) {
  return room_beside(affine_parts(seen.pair), seen.inliers,
                     {seen.pose.R, seen.pose.t.normalized()});
}

/// The roll to the right of the first view against the road, by the road alone.
AngleBelief roll_against(const RoadStep& step, const RoadAlignment& aligned) {
  const double prior = 1.0 / (step.roll_sigma * step.roll_sigma);
  const double both = 1.0 / (aligned.roll_sigma * aligned.roll_sigma);
  if (!(aligned.roll_sigma > 0.0) || both < 2.0 * prior) return {};
  const double believed = tilt_from_down(step.R_level_cam.row(1).transpose()).roll_right;
  return {believed + aligned.roll * both / (both - prior), 1.0 / std::sqrt(both - prior)};
}

}  // namespace

RoadTravel road_travel(const RoadPair& road, const TwoView& seen, const RoadTravelPrior& prior) {
  if (road.empty() || !(prior.seconds > 0.0)) return {};
  const double height = prior.camera_height > 0.0 ? prior.camera_height : kUsualHeight;
  const bool directed = seen.status == StepStatus::kOk && seen.pose.t.norm() > 0.0;
  RoadStep step;
  step.T_2_1 = {seen.pose.R, directed ? seen.pose.t : prior.heading};
  if (!step.T_2_1.is_finite() || !(step.T_2_1.t.norm() > 0.0)) return {};
  if (!goes_along(step.T_2_1.t, prior.heading)) return {};
  const double direction_sigma =
      directed ? rms(seen.covariance.bottomRightCorner<3, 3>(), kTravelSigma) : kHeadingSigma;
  step.information = motion_information(
      rms(seen.covariance.topLeftCorner<3, 3>(), kUntoldTurnSigma), direction_sigma);
  step.R_level_cam = prior.first.R_level_cam;
  step.pitch_sigma = std::max(prior.first.pitch_sigma, step.pitch_sigma);
  step.roll_sigma = std::max(prior.first.roll_sigma, step.roll_sigma);
  expect(prior, height, directed, step);
  if (!lies_in_the_road(step, direction_sigma)) return {};
  RoadAlignmentOptions options;
  options.half_width = std::min(options.half_width, kStrip_m / height);
  const RoadAlignment aligned =
      align_road({road.first, road.second, road.mask}, road.camera, step, options, road.workers);
  if (aligned.status == RoadStatus::kAmbiguous) return {std::nullopt, true};
  if (aligned.status != RoadStatus::kMeasured) return {};
  const double sigma = std::max(aligned.sigma, kLeastSigma);
  const double reach = kBeyond * sigma;  // the fit may leave what was searched
  if (aligned.length < step.min_length - reach || aligned.length > step.max_length + reach) {
    return {};
  }
  // Two views saw a translation: a road that rests contradicts them, and one of the two is wrong.
  if (directed && aligned.length < reach) return {};
  if (directed && !is_wide_enough((aligned.length + reach) * room_beside(seen))) {
    return {};
  }
  if (looks_aside(step) && aligned.length > reach) return {};
  const double unit = prior.camera_height > 0.0 ? prior.camera_height : 1.0;
  return {MeasuredTravel{aligned.length * unit, sigma * unit, LengthSource::kRoadImage,
                         prior.camera_height > 0.0, aligned.reach,
                         looks_aside(step) ? AngleBelief{} : roll_against(step, aligned)}};
}

}  // namespace oneac
