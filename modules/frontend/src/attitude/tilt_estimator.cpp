#include "oneac/frontend/tilt_estimator.h"

#include "mainly_forward.h"
#include "wrapped_angle.h"

#include "oneac/base/median.h"
#include "oneac/geometry/angles.h"
#include "oneac/geometry/robust_loss.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace oneac {
namespace {

// [rad] a direction of travel more than 15° above or below the given horizon is no drive.
constexpr double kLargestElevation = 0.26;
// [rad] 1σ of a pitch or roll that somebody states: sensor poses are a degree off.
constexpr double kGivenSigma = 1.0 * kDegree;
// [rad] 1σ of a roll that a log says nothing of: cameras are put up level by eye.
constexpr double kSilentRollSigma = 2.0 * kDegree;
// [rad] 1σ of a tilt nobody states: cameras on cars are within 10° of level.
constexpr double kUnknownSigma = 10.0 * kDegree;
// [rad] least turn about the lateral axis from one image to the next, 1σ: the body's on its
// springs.
constexpr double kLeastPitching = 0.1 * kDegree;
// [rad] 1σ of a direction that tells less than what springs do to a body.
constexpr double kVague = 1.0 * kDegree;
// [steps] turns that are remembered, 100 s at 10 Hz: bends are rare, and the roll of the camera on
// the level car changes when somebody gets in.
constexpr std::size_t kTurns = 1000;
// [rad] 1σ of the road in view against the one that the wheels are on: roads fall by 2.5 % to
// their sides, and kerbs and crowns bend them.
constexpr double kCrossFall = 1.4 * kDegree;
// [steps] roads that are remembered, and how many of them see the same stretch.
constexpr std::size_t kRoads = 100;
constexpr double kSameRoad = 10.0;
// [-] Where a road has little texture its rolls scatter by so many of their sigmas.
constexpr double kRoadSigmas = 2.0;
// [rad] least scatter of the direction of travel from step to step: what the images resolve.
constexpr double kLeastScatter = 0.2 * kDegree;
// [rad] 1σ of the first step, which shows one state of the springs; they swing within a few steps.
constexpr double kFirstSteps = 1.0 * kDegree;
// [σ] a turn whose roll is farther off than this weighs little.
constexpr double kRollCut = 3.0;
constexpr int kRollIterations = 5;
constexpr double kMadToSigma = 1.4826;

/// [rad] 1σ of the turns about the lateral axis that a camera with this roll does not explain.
double pitching_beside(double roll, const std::vector<Eigen::Vector3d>& turns) {
  std::vector<double> off;
  off.reserve(turns.size());
  for (const Eigen::Vector3d& turn : turns) off.push_back(std::abs(turn.x() - roll * turn.y()));
  return std::max(kMadToSigma * upper_median(std::move(off)), kLeastPitching);
}

}  // namespace

TiltEstimator::TiltEstimator(const Tilt& given, const TiltOptions& options, bool told)
    : given_(given), told_(told), options_(options), unknown_(options.source == "drive") {
  update();
}

void TiltEstimator::set_given(const Tilt& given) {
  given_ = given;
  update();
}

void TiltEstimator::see_road(const AngleBelief& roll_right) {
  if (!options_.refine || !(roll_right.sigma > 0.0)) return;
  roads_.push_back(roll_right);
  if (roads_.size() > kRoads) roads_.pop_front();
  update();
}

void TiltEstimator::add_step(const RelativePose& T_2_1, double elevation_sigma) {
  if (!options_.refine) return;
  const auto limit = static_cast<std::size_t>(options_.window_steps);
  const Eigen::AngleAxisd turn(T_2_1.R);
  turns_.push_back(turn.angle() * turn.axis());
  if (turns_.size() > kTurns) turns_.pop_front();
  if (T_2_1.t.norm() > 0.0 && elevation_sigma < kVague) {
    // Points move against the camera: it travels along −t. Backing says the same as driving.
    const Eigen::Vector3d along = -T_2_1.t.normalized();
    const Eigen::Vector3d forward = along.z() > 0.0 ? along : Eigen::Vector3d(-along);
    const Eigen::Vector3d travel = levelling_rotation(given_) * forward;
    if (travel.z() > kMainlyForward &&
        std::abs(std::atan2(travel.y(), travel.z())) < kLargestElevation)
      travels_.push_back(forward);
    if (travels_.size() > limit) travels_.pop_front();
  }
  update();
}

void TiltEstimator::update() {
  belief_.tilt.pitch_up = given_.pitch_up + pitch_correction(belief_.pitch_sigma);
  belief_.tilt.roll_right = given_.roll_right + roll_correction(belief_.roll_sigma);
}

double TiltEstimator::pitch_correction(double& sigma) const {
  const double prior = unknown_ ? kUnknownSigma : kGivenSigma;
  sigma = prior;
  if (travels_.empty()) return 0.0;
  const Eigen::Matrix3d L = levelling_rotation(given_);
  std::vector<double> elevations;
  for (const Eigen::Vector3d& forward : travels_) {
    const Eigen::Vector3d travel = L * forward;
    // A camera pitched up sees its travel below the axis (Y down > 0).
    elevations.push_back(std::atan2(travel.y(), travel.z()));
  }
  const double middle = upper_median(elevations);
  std::vector<double> off;
  off.reserve(elevations.size());
  for (const double elevation : elevations) off.push_back(std::abs(elevation - middle));
  const double scatter = std::max(kMadToSigma * upper_median(std::move(off)), kLeastScatter);
  const double count = static_cast<double>(elevations.size());
  const double trust = unknown_ ? 1.0 : count / (count + worth_of_given(middle));
  const double variance = scatter * scatter / count + kFirstSteps * kFirstSteps / (count * count);
  sigma =
      std::hypot(1.0 / std::sqrt(1.0 / variance + 1.0 / (prior * prior)), (1.0 - trust) * middle);
  return trust * middle;
}

/// [steps] What is given is off by a degree; what the drive contradicts by more is a blunder, or
/// nobody said anything (Cauchy's law).
double TiltEstimator::worth_of_given(double off) const {
  const double scaled = off / kGivenSigma;
  return options_.prior_steps / (1.0 + scaled * scaled);
}

double TiltEstimator::given_roll_sigma() const {
  if (unknown_) return kUnknownSigma;
  return told_ ? kGivenSigma : kSilentRollSigma;
}

AngleBelief TiltEstimator::roll_off_by_road() const {
  if (roads_.empty()) return {0.0, std::numeric_limits<double>::infinity()};
  std::vector<double> rolls, off, sigmas;
  for (const AngleBelief& road : roads_) {
    rolls.push_back(wrapped_angle(road.angle - given_.roll_right));
    sigmas.push_back(road.sigma);
  }
  const double middle = upper_median(rolls);
  for (const double roll : rolls) off.push_back(std::abs(roll - middle));
  const double scatter = std::max(kMadToSigma * upper_median(std::move(off)),
                                  kRoadSigmas * upper_median(std::move(sigmas)));
  const double stretches = std::max(static_cast<double>(roads_.size()) / kSameRoad, 1.0);
  return {middle, std::hypot(kCrossFall, scatter / std::sqrt(stretches))};
}

double TiltEstimator::roll_correction(double& sigma) const {
  const double prior = given_roll_sigma();
  const AngleBelief road = roll_off_by_road();
  const double held = 1.0 / (prior * prior) + 1.0 / (road.sigma * road.sigma);
  const double held_at = road.angle / (road.sigma * road.sigma);
  sigma = 1.0 / std::sqrt(held);
  if (turns_.empty()) return held_at / held;
  const Eigen::Matrix3d L = levelling_rotation(given_);
  std::vector<Eigen::Vector3d> level;
  for (const Eigen::Vector3d& turn : turns_) level.push_back(L * turn);
  double roll = held_at / held;
  for (int iteration = 0; iteration < kRollIterations; ++iteration) {
    const double pitching = pitching_beside(roll, level);
    double information = held;
    double sum = held_at;
    for (const Eigen::Vector3d& turn : level) {
      // A camera that leans right by ρ sees a turn ω about the upright as (ω sin ρ, ω cos ρ).
      const double z = (turn.x() - roll * turn.y()) / pitching;
      const double robust = 1.0 / geman_mcclure_divisor(z * z, kRollCut * kRollCut);
      const double weight = robust / (pitching * pitching);
      information += weight * turn.y() * turn.y();
      sum += weight * turn.x() * turn.y();
    }
    roll = sum / information;
    sigma = 1.0 / std::sqrt(information);
  }
  return roll;
}

Tilt tilt_from_gravity(const Eigen::Matrix3d& R_vehicle_cam, const Eigen::Vector3d& acceleration) {
  // At rest the accelerometer feels the ground push upwards.
  return tilt_from_down(R_vehicle_cam.transpose() * -acceleration);
}

}  // namespace oneac
