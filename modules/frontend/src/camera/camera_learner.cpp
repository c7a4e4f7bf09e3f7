#include "camera/camera_learner.h"

#include "camera/focal_doubt.h"

#include "oneac/base/number_text.h"
#include "oneac/geometry/angles.h"

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
constexpr std::size_t kFewestBends = 2;

}  // namespace

void CameraLearner::start(const PinholeCamera& given) {
  belief_ = {};
  belief_.given = belief_.used = given;
  belief_.focal_px = given.focal_px();
  belief_.focal_sigma = options_.focal_sigma;
  intrinsics_.emplace(given, prior());
  belief_.drive_sigma = intrinsics_->estimate().drive_sigma[kFocal];
  static_cast<void>(cutter_.finish());
  change_.setZero();
  contradicted_ = false;
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
    view.sightings.push_back({seen.track, belief_.used.project(seen.x)});
  }
  const auto window = cutter_.add(std::move(view));
  if (!window || !measure(*window) || options_.refine == "off") return false;
  // A camera that was calibrated well is better than a bend's half per cent.
  contradicted_ = contradicted_ || contradicts(kDoubtful);
  if (!contradicted_) return false;
  IntrinsicsVector focal = IntrinsicsVector::Zero();
  focal[kFocal] = change_[kFocal];
  belief_.used = changed(belief_.given, focal);
  return true;
}

void CameraLearner::finish() {
  if (options_.looks()) measure(cutter_.finish());
}

bool CameraLearner::measure(const CalibrationWindow& window) {
  if (window.views.empty() || turn_of(window) < options_.min_turn_deg * kDegree) return false;
  MeasurementOptions options;
  options.most_tracks = kMostTracks;
  const auto measured = measure_intrinsics(window, belief_.given, change_, prior(), options);
  if (!measured) return false;
  intrinsics_->add(*measured);
  const IntrinsicsEstimate estimate = intrinsics_->estimate();
  change_ = estimate.change;
  belief_.focal_px = estimate.camera.focal_px();
  belief_.focal_sigma = estimate.sigma(kFocal);
  belief_.drive_sigma = estimate.drive_sigma[kFocal];
  belief_.bends = estimate.windows;
  if (belief_.bends >= kFewestBends) {
    belief_.doubt = focal_doubt(change_[kFocal], belief_.focal_sigma);
  }
  belief_.history.push_back({index_, time_s_, belief_.focal_px, belief_.focal_sigma});
  return true;
}

bool CameraLearner::contradicts(double sigmas) const {
  return belief_.bends >= kFewestBends && std::abs(change_[kFocal]) >= sigmas * belief_.focal_sigma;
}

std::optional<std::string> CameraLearner::fault() const {
  if (!contradicts(kSure) || std::abs(change_[kFocal]) < kTolerated) return std::nullopt;
  return "the bends of this drive say a focal length of " + fixed_text(belief_.focal_px, 0) +
         " px (to " + fixed_text(100.0 * belief_.focal_sigma, 1) +
         " %) where the calibration has " + fixed_text(belief_.given.focal_px(), 0) +
         " px, so nothing is in metres; give the calibration of these images with --calibration, "
         "or one that \"oneac calibrate LOG -o camera.ini\" makes of the drive";
}

}  // namespace oneac
