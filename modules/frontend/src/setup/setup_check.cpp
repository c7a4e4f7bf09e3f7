#include "setup/setup_check.h"

#include "oneac/base/number_text.h"
#include "oneac/geometry/angles.h"
#include "oneac/geometry/camera_plausibility.h"
#include "oneac/geometry/levelling.h"
#include "oneac/geometry/triangulation.h"
#include "oneac/robust/ground_scale.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace oneac {
namespace {

// [steps] before anything is said: a bend or a crossing car lasts as long.
constexpr std::size_t kFewestSteps = 30;
// [looks] for the road before anything is said of it, and those that have to show it elsewhere.
constexpr std::size_t kFewestLooks = 8, kFewestRoads = 6;
// [steps] between two looks, at first and later.
constexpr std::size_t kLookEvery = 3, kLookLater = 20;
// [rad] beyond which travel is off the believed heading: bends and slip stay within 15°.
constexpr double kOff = 30.0 * kDegree;
// Shares of the steps that are off, and that swing: noise alone swings with every second step.
constexpr double kMostOff = 0.6, kMostSwing = 0.8;
// Length of the mean direction of travel: 0 for noise in all directions, 1 for one direction.
constexpr double kOneDirection = 0.7;
// [rad] of travel to the side, from one image to the next to the other side: no vehicle does it.
constexpr double kSwing = 5.0 * kDegree;
// Share of the looks in which a road lies elsewhere, and how much rarer one is below.
constexpr double kElsewhere = 0.5, kRarerBelow = 0.25;
// A road is nearer than other planes by this: 1.5 m below the camera, where walls stand at 2.3 m.
constexpr double kNearer = 1.5;
// [heights] to each side of the point below the camera, and share of a road's points beyond: two
// thirds of a lane's half. A wall reaches down to the ground only: less, unless it is within 2 m.
constexpr double kToEachSide = 0.8, kShareAtEachSide = 0.1;
// Steps, and their share, that would have been faster than any car: one may be a wrong measurement.
constexpr std::size_t kFewestTooFast = 10;
constexpr double kMostTooFast = 0.1;
// [rad] of a camera's axis from the vehicle's: beyond, travel does not show its pitch.
constexpr double kLooksAside = 45.0 * kDegree;
// [rad] a pitch that nobody told is zero.
constexpr double kNoPitch = 1e-6;
// [-] relative distance from a plane of a point that lies on it, as kPlaneCut of ground_scale().
constexpr double kOnPlane = 0.12;
// [px] 1σ of a point's position.
constexpr double kPointSigma_px = 0.5;

constexpr std::size_t kBelow = 0, kAtRight = 1, kAbove = 2, kAtLeft = 3;

Eigen::Vector3d travel_of(const RelativePose& pose) {
  return -(pose.R.transpose() * pose.t).normalized();  // of the camera, in the first view
}

double share(std::size_t part, std::size_t all) {
  return static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(all, 1));
}

/// Whether points on a plane below the camera lie on both sides of the point below it.
/// @param height  of the camera above the plane [steps]
bool reaches_to_both_sides(const std::vector<AffineCorrespondence>& acs, const TwoView& seen,
                           const Eigen::Matrix3d& R_level_cam, double height) {
  std::size_t on_plane = 0, left = 0, right = 0;
  for (std::size_t i = 0; i < acs.size(); ++i) {
    if (!seen.inliers[i]) continue;
    const auto point = triangulate(seen.pose, acs[i].x1, acs[i].x2);
    if (!point || !point->in_front()) continue;
    const Eigen::Vector3d X = R_level_cam * (point->z1 * acs[i].x1.homogeneous()) / height;
    if (std::abs(X.y() - 1.0) > kOnPlane || X.z() > GroundScaleOptions{}.max_distance) continue;
    ++on_plane;
    if (X.x() < -kToEachSide) ++left;
    if (X.x() > kToEachSide) ++right;
  }
  return on_plane > 0 && share(std::min(left, right), on_plane) >= kShareAtEachSide;
}

/// The levelling that the travel shows, which is horizontal, with the roll as believed; as believed
/// for a camera that looks aside.
Eigen::Matrix3d levelling_by_travel(const RelativePose& pose, const Eigen::Matrix3d& R_level_cam) {
  Eigen::Vector3d along = travel_of(pose);
  if (along.z() < 0.0) along = -along;
  if (along.z() < std::cos(kOff)) return R_level_cam;
  const Eigen::Matrix3d ahead =
      Eigen::Quaterniond::FromTwoVectors(along, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Tilt believed = tilt_from_down(R_level_cam.row(1).transpose());
  return levelling_rotation({0.0, believed.roll_right}) * ahead;
}

/// Where a road lies: at the nearest plane, turned by quarters to the right about the axis.
std::optional<std::size_t> road_of(const TwoView& seen, const Eigen::Matrix3d& R_level_cam) {
  const std::vector<AffineCorrespondence> acs = affine_parts(seen.pair);
  const Eigen::Matrix3d believed = levelling_by_travel(seen.pose, R_level_cam);
  std::array<double, 4> heights{};
  std::array<Eigen::Matrix3d, 4> levels;
  for (std::size_t quarter = 0; quarter < heights.size(); ++quarter) {
    const Eigen::AngleAxisd turn(0.5 * M_PI * static_cast<double>(quarter),
                                 Eigen::Vector3d::UnitZ());
    levels[quarter] = turn * believed;
    const auto plane = ground_scale(acs, seen.inliers, seen.pose, levels[quarter],
                                    kPointSigma_px / seen.focal_px, {});
    heights[quarter] =
        plane ? seen.pose.t.norm() / plane->baseline : std::numeric_limits<double>::infinity();
  }
  const auto nearest = std::min_element(heights.begin(), heights.end());
  const bool alone = std::count_if(heights.begin(), heights.end(), [&](double height) {
                       return height <= kNearer * *nearest;
                     }) == 1;
  const auto quarter = static_cast<std::size_t>(nearest - heights.begin());
  if (!alone || !reaches_to_both_sides(acs, seen, levels[quarter], *nearest)) return std::nullopt;
  return quarter;
}

/// The flags of a mount; zeros are left out, as they are when it is read.
std::string flags_of(const MountAngles& mount) {
  std::string flags = "--mount-roll " + fixed_text(mount.roll_right_deg, 0);
  if (std::abs(mount.pitch_up_deg) >= 0.1) {
    flags += " --mount-pitch " + fixed_text(mount.pitch_up_deg, 1);
  }
  if (std::abs(mount.yaw_left_deg) >= 0.5) {
    flags += " --mount-yaw " + fixed_text(mount.yaw_left_deg, 0);
  }
  return flags;
}

std::string road_fault(const char* side, MountAngles believed, double more_roll_deg) {
  believed.roll_right_deg = std::remainder(believed.roll_right_deg + more_roll_deg, 360.0);
  return std::string("the road does not lie below the camera but ") + side +
         ", so nothing is in metres; if the camera is mounted so, say it with " +
         flags_of(believed);
}

MountAngles angles_of(const Eigen::Matrix3d& R_vehicle_cam) {
  const Tilt tilt = tilt_from_mounting(R_vehicle_cam);
  const Eigen::Vector3d axis = R_vehicle_cam.col(2);
  return {tilt.roll_right / kDegree, tilt.pitch_up / kDegree,
          std::atan2(axis.y(), axis.x()) / kDegree};
}

}  // namespace

void SetupCheck::start(const CameraFrame& first) {
  *this = {};
  for (const std::string& fault : camera_faults(first.camera)) {
    of_camera_.push_back("the calibration cannot be that of these images (" + fault +
                         "), so nothing is in metres; give theirs with --calibration "
                         "FILE[:SECTION]");
  }
  faults_ = of_camera_;
  const Eigen::Matrix3d R_vehicle_cam = first.T_vehicle_cam.linear();
  believed_ = angles_of(R_vehicle_cam);
  const Eigen::Matrix3d R_level_cam = levelling_rotation(tilt_from_mounting(R_vehicle_cam));
  nose_ = R_level_cam * R_vehicle_cam.transpose() * Eigen::Vector3d::UnitX();
}

StepLength SetupCheck::checked_after(StepLength length) {
  if (length.metric || length.refused) ++speeds_.count;
  if (length.too_fast) ++speeds_.too_fast;
  if (metric_allowed()) return length;
  length.metric = false;
  length.sigma = 0.0;
  return length;
}

ScaleCorrection SetupCheck::checked(ScaleCorrection correction) const {
  correction.metric = correction.metric && metric_allowed();
  return correction;
}

void SetupCheck::follow(const TwoView& seen, const Eigen::Matrix3d& R_level_cam) {
  if (seen.status != StepStatus::kOk || !(seen.pose.t.norm() > 0.0)) return;
  if (travels_.count == 0) {
    const bool aside = std::abs(nose_.z()) < std::cos(kLooksAside);
    const Tilt told = tilt_from_down(R_level_cam.row(1).transpose());
    pitch_is_missing_ = aside && std::abs(told.pitch_up) < kNoPitch;
  }
  remember(seen, R_level_cam);
  const std::size_t every = looks_.count < kFewestLooks ? kLookEvery : kLookLater;
  if (travels_.count % every == 0) look_for_road(seen, R_level_cam);
  of_drive_ = faults_of_drive();
  gather();
}

void SetupCheck::blame_camera(const std::optional<std::string>& fault) {
  of_focal_ = fault;
  gather();
}

void SetupCheck::gather() {
  faults_ = of_camera_;
  if (of_focal_) faults_.push_back(*of_focal_);
  faults_.insert(faults_.end(), of_drive_.begin(), of_drive_.end());
}

std::optional<std::string> SetupCheck::fault_of_pitch() const {
  if (!pitch_is_missing_) return std::nullopt;
  return "how far a camera that looks aside looks up cannot be seen while driving and nobody told "
         "it, so nothing is in metres; give its angle above the horizon with --mount-pitch (0.1 "
         "for a level one)";
}

void SetupCheck::remember(const TwoView& seen, const Eigen::Matrix3d& R_level_cam) {
  const Eigen::Vector3d along = R_level_cam * travel_of(seen.pose);
  const double ahead = along.dot(nose_);
  const Eigen::Vector3d left = Eigen::Vector3d::UnitY().cross(nose_) * -1.0;
  // Of the line of travel: between two cameras even the sense of a step can be taken wrongly.
  const double to_the_left =
      std::atan2(std::copysign(1.0, ahead) * along.dot(left), std::abs(ahead));
  const double before = std::exchange(travels_.last_to_the_left, to_the_left);
  const bool other_side = before * to_the_left < 0.0;
  if (other_side && std::min(std::abs(before), std::abs(to_the_left)) > kSwing) ++travels_.swings;
  if (std::acos(std::min(std::abs(ahead), 1.0)) > kOff) ++travels_.off;
  travels_.sum += along;
  ++travels_.count;
}

void SetupCheck::look_for_road(const TwoView& seen, const Eigen::Matrix3d& R_level_cam) {
  ++looks_.count;
  if (const auto road = road_of(seen, R_level_cam)) ++looks_.road[*road];
}

std::vector<std::string> SetupCheck::faults_of_drive() const {
  std::vector<std::string> faults;
  const auto swing = fault_of_swing();
  const auto heading = swing ? std::nullopt : fault_of_heading();
  for (const auto& fault : {swing, heading, fault_of_road(), fault_of_pitch(), fault_of_speed()}) {
    if (fault) faults.push_back(*fault);
  }
  return faults;
}

std::optional<std::string> SetupCheck::fault_of_swing() const {
  if (travels_.count < kFewestSteps) return std::nullopt;
  if (share(travels_.swings, travels_.count - 1) < kMostSwing) return std::nullopt;
  return "the camera swings from side to side with every image, like two cameras under one label, "
         "so nothing is in metres; give each camera a label of its own";
}

std::optional<std::string> SetupCheck::fault_of_heading() const {
  if (travels_.count < kFewestSteps) return std::nullopt;
  if (share(travels_.off, travels_.count) < kMostOff) return std::nullopt;
  const Eigen::Vector3d mean = travels_.sum / static_cast<double>(travels_.count);
  if (mean.norm() < kOneDirection) return std::nullopt;
  const double angle = std::acos(std::min(std::abs(mean.normalized().dot(nose_)), 1.0));
  return "the camera travels " + fixed_text(angle / kDegree, 0) +
         "° off the direction that its mount calls ahead, so nothing is in metres; say how it is "
         "mounted with --mount-yaw, --mount-roll and --mount-pitch, or --mount-convention";
}

std::optional<std::string> SetupCheck::fault_of_speed() const {
  if (speeds_.too_fast < kFewestTooFast) return std::nullopt;
  if (share(speeds_.too_fast, speeds_.count) < kMostTooFast) return std::nullopt;
  return "the lengths of " + std::to_string(speeds_.too_fast) + " of " +
         std::to_string(speeds_.count) +
         " steps are speeds above 250 km/h, so nothing is in metres; give the stamps of these "
         "images, or the camera's height (--camera-height)";
}

std::optional<std::string> SetupCheck::fault_of_road() const {
  if (looks_.count < kFewestLooks) return std::nullopt;
  const auto lies = [this](std::size_t quarter) {
    const std::size_t there = looks_.road[quarter];
    return there >= kFewestRoads && share(there, looks_.count) > kElsewhere &&
           share(looks_.road[kBelow], there) < kRarerBelow;
  };
  if (lies(kAbove)) return road_fault("above it", believed_, 180.0);
  if (lies(kAtRight)) return road_fault("at its right side", believed_, 90.0);
  if (lies(kAtLeft)) return road_fault("at its left side", believed_, -90.0);
  return std::nullopt;
}

}  // namespace oneac
