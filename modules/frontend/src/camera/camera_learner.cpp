#include "camera/camera_learner.h"

#include "camera/focal_doubt.h"

#include "oneac/base/number_text.h"
#include "oneac/geometry/angles.h"
#include "oneac/geometry/lens.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oneac {
namespace {

// [tracks] of a window that is measured on the way: half of what an idle calibration takes.
constexpr std::size_t kMostTracks = 200;
// [σ] and [-] of ln f: lengths by the road are wrong as the focal length is, and three per cent are
// what is taken for granted of it. One bend, which a crossing bus may fill, accuses nobody.
constexpr double kSure = 3.0, kTolerated = 0.03;
// [σ] from which what bends say is used: of good calibrations they contradict one in twenty.
constexpr double kDoubtful = 2.0;
constexpr double kDoubtfulOfAll = 2.57;   // [σ] of one of five unknowns: as rare
constexpr std::size_t kBendsOfALens = 3;  // whose scatter is that of five unknowns
// [-] of ln f: who is farther away does not measure the camera's turns.
constexpr double kPlausible = 0.35;

/// How far lengths by the given focal length are to be doubted. Where sensors contradict, the
/// bends alone are heard, too: what is widened accuses less. Sensors that only contradict each
/// other may each be right.
double doubt_of(const JointEstimate& joint, const IntrinsicsEstimate& bends,
                const std::vector<FocalEvidence>& told) {
  const bool by_bends = bends.windows >= IntrinsicsBelief::kFewestWindows;
  if (!by_bends && told.empty()) return 0.0;
  double doubt = focal_doubt(joint.estimate.change[kFocal], joint.estimate.sigma(kFocal));
  if (joint.contradicting.empty()) return doubt;
  if (by_bends) return std::max(doubt, focal_doubt(bends.change[kFocal], bends.sigma(kFocal)));
  for (const FocalEvidence& one : told) {
    if (std::abs(one.log_focal) > kPlausible) continue;
    doubt = std::max(doubt, focal_doubt(one.log_focal, one.sigma));
  }
  return doubt;
}

}  // namespace

void CameraLearner::start(const PinholeCamera& given, const PinholeCamera& raw) {
  // A longer focal length is none of other lenses: theirs is that of undistorted images, unless
  // all of the lens is learned.
  const bool five = is_five_term_lens(raw);
  const bool knows_raw = raw.width > 0 && (five || options_.refine == "full");
  scales_ = five || !knows_raw;
  belief_ = {};
  belief_.given = belief_.used = given;
  belief_.raw_used = belief_.raw_learned = raw_ = knows_raw ? raw : given;
  belief_.knows_raw = knows_raw;
  belief_.focal_px = given.focal_px();
  belief_.focal_sigma = options_.focal_sigma;
  intrinsics_.emplace(raw_, prior());
  const IntrinsicsEstimate before = intrinsics_->estimate();
  belief_.drive_sigma = before.drive_sigma[kFocal];
  belief_.sigma = before.covariance.diagonal().cwiseSqrt();
  static_cast<void>(cutter_.finish());
  change_.setZero();
  contradicted_ = moves_lens_ = confirmed_ = false;
  accused_sigmas_ = 0.0;
}

IntrinsicsPrior CameraLearner::prior() const {
  return {options_.focal_sigma, options_.centre_sigma, options_.k1_sigma, options_.k2_sigma};
}

bool CameraLearner::follow(const NewestKeyframe& keyframe, std::size_t index, double time_s) {
  if (!options_.looks()) return false;
  index_ = index;
  time_s_ = time_s;
  CalibrationView view{keyframe.T_cam_map, {}};
  view.sightings.reserve(keyframe.sightings.size());
  for (const KeyframeSighting& seen : keyframe.sightings) {
    view.sightings.push_back({seen.track, project_distorted(belief_.raw_used, seen.x)});
  }
  const auto window = cutter_.add(std::move(view));
  return window && measure(*window) && move();
}

bool CameraLearner::move() {
  if (!learns()) return false;
  // A camera that was calibrated well is better than a bend's half per cent.
  const bool focal = std::abs(change_[kFocal]) >= kDoubtful * belief_.focal_sigma;
  contradicted_ = contradicted_ || (confirmed_ && focal && scales_);
  moves_lens_ = moves_lens_ || lens_is_doubtful();
  if (!contradicted_ && !moves_lens_) return false;
  belief_.raw_used =
      moves_lens_ ? belief_.raw_learned : with_longer_focal(raw_, std::exp(change_[kFocal]));
  belief_.used = pinhole_of(belief_.given, raw_, belief_.raw_used);
  return true;
}

std::optional<LearnedLens> CameraLearner::lens() const {
  if (!moves_lens_) return std::nullopt;
  return LearnedLens(belief_.given, belief_.used, raw_, belief_.raw_used);
}

/// One unknown by one: together, k1 and k2 are surer than a lens is of two terms.
bool CameraLearner::lens_is_doubtful() const {
  if (options_.refine != "full" || belief_.bends < kBendsOfALens) return false;
  return (change_.cwiseAbs().array() >= kDoubtfulOfAll * belief_.sigma.array()).any();
}

void CameraLearner::add_yaw_rate(double time_s, double rate) {
  if (learns()) turns_.add_yaw_rate(time_s, rate);
}

void CameraLearner::add_course(double time_s, double course, double speed) {
  if (learns()) turns_.add_course(time_s, course, speed);
}

void CameraLearner::add_frame(double time_s, bool carried) {
  if (!learns()) return;
  time_s_ = time_s;
  turns_.add_frame(time_s, carried, std::log(belief_.used.fx / belief_.given.fx));
}

bool CameraLearner::follow_turns(const std::vector<SettledFrame>& settled, const Tilt& tilt) {
  if (!learns() || !turns_.settle(settled, tilt) || turns_.evidence().empty()) return false;
  conclude();
  return move();
}

void CameraLearner::finish() {
  if (options_.looks()) measure(cutter_.finish());
}

bool CameraLearner::measure(const CalibrationWindow& window) {
  if (window.views.empty() || turn_of(window) < options_.min_turn_deg * kDegree) return false;
  MeasurementOptions options;
  options.most_tracks = kMostTracks;
  const auto measured = measure_intrinsics(window, raw_, change_, prior(), options);
  if (!measured) return false;
  intrinsics_->add(*measured);
  conclude();
  return true;
}

void CameraLearner::conclude() {
  const std::vector<FocalEvidence> told = turns_.evidence();
  const IntrinsicsEstimate bends = intrinsics_->estimate();
  JointEstimate joint = joint_estimate(*intrinsics_, told);
  const IntrinsicsEstimate& estimate = joint.estimate;
  change_ = estimate.change;
  confirmed_ = joint.is_confirmed();
  // A sensor that contradicts takes nothing away from what the bends say.
  const IntrinsicsEstimate& accuser = joint.contradicting.empty() ? estimate : bends;
  accused_sigmas_ = std::abs(accuser.change[kFocal]) / accuser.sigma(kFocal);
  belief_.focal_px = belief_.given.focal_px() * std::exp(change_[kFocal]);
  belief_.focal_sigma = estimate.sigma(kFocal);
  belief_.drive_sigma = estimate.drive_sigma[kFocal];
  belief_.bends = estimate.windows;
  belief_.raw_learned = estimate.camera;
  belief_.sigma = estimate.covariance.diagonal().cwiseSqrt();
  belief_.doubt = doubt_of(joint, bends, told);
  belief_.sensors = std::move(joint.agreeing);
  belief_.contradicting = std::move(joint.contradicting);
  belief_.history.push_back(
      {index_, time_s_, belief_.focal_px, belief_.focal_sigma, belief_.raw_learned, belief_.sigma});
}

std::optional<std::string> CameraLearner::fault() const {
  const bool sure = confirmed_ && accused_sigmas_ >= kSure;
  if (!sure || std::abs(change_[kFocal]) < kTolerated) return std::nullopt;
  return "the bends of this drive say a focal length of " + fixed_text(belief_.focal_px, 0) +
         " px (to " + fixed_text(100.0 * belief_.focal_sigma, 1) +
         " %) where the calibration has " + fixed_text(belief_.given.focal_px(), 0) +
         " px, so nothing is in metres; give the calibration of these images with --calibration, "
         "or one that \"oneac calibrate LOG -o camera.ini\" makes of the drive";
}

}  // namespace oneac
