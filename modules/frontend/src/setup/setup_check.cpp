#include "setup/setup_check.h"

#include "oneac/base/median.h"
#include "oneac/base/number_text.h"
#include "oneac/geometry/angles.h"
#include "oneac/geometry/camera_plausibility.h"
#include "oneac/geometry/leveling.h"
#include "oneac/robust/ground_scale.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>

namespace oneac {
namespace {

// [steps] that moved and are remembered: 10 s of a city drive at 20 Hz; a manoeuvre is shorter.
constexpr std::size_t kSteps = 200;
// [steps] and [looks] before anything is said: a bend or a crossing car lasts as long.
constexpr std::size_t kFewestSteps = 30, kFewestLooks = 8;
// [looks] remembered.
constexpr std::size_t kLooks = 40;
// [steps] between two looks for the road, at first and later.
constexpr std::size_t kLookEvery = 3, kLookLater = 20;
// [rad] beyond which travel is off the believed heading: bends and slip stay within 15°.
constexpr double kOff = 30.0 * kDegree;
// Shares of the steps that are off, and that swing: noise alone swings with every second step.
constexpr double kMostOff = 0.6, kMostSwing = 0.8;
// [rad] of travel to the side, from one image to the next to the other side: no vehicle does it.
constexpr double kSwing = 5.0 * kDegree;
// Share of the looks in which a road is there, or is not.
constexpr double kThere = 0.5, kNotThere = 0.2;
// So much rarer is one below than one above, or at one side: there walls stand beside many a road.
constexpr double kRarerThanAbove = 0.5, kRarerThanBeside = 0.25;
// [px] 1σ of a point's position.
constexpr double kPointSigma_px = 0.5;

constexpr std::size_t kBelow = 0, kAtRight = 1, kAbove = 2, kAtLeft = 3;

Eigen::Vector3d travel_of(const RelativePose& pose) {
  return -(pose.R.transpose() * pose.t).normalized();  // of the camera, in the first view
}

template <class Items, class Predicate>
double share_of(const Items& items, Predicate&& predicate) {
  const auto count = std::count_if(items.begin(), items.end(), predicate);
  return static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(items.size(), 1));
}

std::string road_fault(const char* side, const char* roll) {
  return std::string("the road is not below the camera but ") + side +
         ", so nothing is in metres; if the camera is mounted so, give --mount-roll with " + roll +
         " degrees more than it has";
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
  const Eigen::Matrix3d R_level_cam = leveling_rotation(tilt_from_mounting(R_vehicle_cam));
  nose_ = R_level_cam * R_vehicle_cam.transpose() * Eigen::Vector3d::UnitX();
}

StepLength SetupCheck::checked(StepLength length) const {
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
  remember(seen, R_level_cam);
  const std::size_t every = looks_.size() < kFewestLooks ? kLookEvery : kLookLater;
  if (moved_++ % every == 0) look_for_road(seen, R_level_cam);
  faults_ = of_camera_;
  for (std::string& fault : faults_of_drive()) faults_.push_back(std::move(fault));
}

void SetupCheck::remember(const TwoView& seen, const Eigen::Matrix3d& R_level_cam) {
  const Eigen::Vector3d along = R_level_cam * travel_of(seen.pose);
  const double ahead = along.dot(nose_);
  const Eigen::Vector3d left = Eigen::Vector3d::UnitY().cross(nose_) * -1.0;
  Travel travel;
  travel.off_heading = std::acos(std::min(std::abs(ahead), 1.0));
  travel.to_the_left = std::atan2(along.dot(left), std::abs(ahead));
  travels_.push_back(travel);
  if (travels_.size() > kSteps) travels_.pop_front();
}

void SetupCheck::look_for_road(const TwoView& seen, const Eigen::Matrix3d& R_level_cam) {
  const std::vector<AffineCorrespondence> acs = affine_parts(seen.pair);
  RoadSeen roads{};
  for (std::size_t quarter = 0; quarter < roads.size(); ++quarter) {
    const Eigen::AngleAxisd turn(0.5 * M_PI * static_cast<double>(quarter),
                                 Eigen::Vector3d::UnitZ());
    const auto road = ground_scale(acs, seen.inliers, seen.pose, turn * R_level_cam,
                                   kPointSigma_px / seen.focal_px, {});
    roads[quarter] = road.has_value();
  }
  looks_.push_back(roads);
  if (looks_.size() > kLooks) looks_.pop_front();
}

std::vector<std::string> SetupCheck::faults_of_drive() const {
  std::vector<std::string> faults;
  const auto swing = fault_of_swing();
  const auto heading = swing ? std::nullopt : fault_of_heading();
  for (const auto& fault : {swing, heading, fault_of_road()}) {
    if (fault) faults.push_back(*fault);
  }
  return faults;
}

std::optional<std::string> SetupCheck::fault_of_swing() const {
  if (travels_.size() < kFewestSteps) return std::nullopt;
  std::size_t swings = 0;
  for (std::size_t i = 1; i < travels_.size(); ++i) {
    const double before = travels_[i - 1].to_the_left, now = travels_[i].to_the_left;
    const bool other_side = before * now < 0.0;
    if (other_side && std::min(std::abs(before), std::abs(now)) > kSwing) ++swings;
  }
  if (static_cast<double>(swings) < kMostSwing * static_cast<double>(travels_.size() - 1)) {
    return std::nullopt;
  }
  return "the camera swings from side to side with every image, like two cameras under one label, "
         "so nothing is in metres; give each camera a label of its own";
}

std::optional<std::string> SetupCheck::fault_of_heading() const {
  if (travels_.size() < kFewestSteps) return std::nullopt;
  const auto off = [](const Travel& travel) { return travel.off_heading > kOff; };
  if (share_of(travels_, off) < kMostOff) return std::nullopt;
  std::vector<double> angles;
  for (const Travel& travel : travels_) angles.push_back(travel.off_heading / kDegree);
  return "the camera travels " + fixed_text(upper_median(std::move(angles)), 0) +
         "° off the direction that its mount calls ahead, so nothing is in metres; say how it is "
         "mounted with --mount-yaw, --mount-roll and --mount-pitch, or --mount-convention";
}

std::optional<std::string> SetupCheck::fault_of_road() const {
  if (looks_.size() < kFewestLooks) return std::nullopt;
  const auto share = [this](std::size_t quarter) {
    return share_of(looks_, [=](const RoadSeen& look) { return look[quarter]; });
  };
  const double below = share(kBelow);
  const auto beside = [&](std::size_t side, std::size_t opposite) {
    return share(side) > kThere && share(opposite) < kNotThere &&
           below < kRarerThanBeside * share(side);
  };
  if (share(kAbove) > kThere && below < kRarerThanAbove * share(kAbove)) {
    return road_fault("above the camera", "180");
  }
  if (beside(kAtRight, kAtLeft)) return road_fault("at its right side", "90");
  if (beside(kAtLeft, kAtRight)) return road_fault("at its left side", "-90");
  return std::nullopt;
}

}  // namespace oneac
