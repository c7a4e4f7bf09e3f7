#include "calibrate/calibration_drive.h"

#include "run/run_drive.h"

#include "oneac/base/error.h"
#include "oneac/base/number_text.h"
#include "oneac/calibration/focal_evidence.h"
#include "oneac/geometry/angles.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oneac::app {
namespace {

// [deg] field of view taken where nobody guesses one: dashcams and robots' cameras have 45 to 90.
constexpr double kUsualFov_deg = 60.0, kUsualFisheye_deg = 120.0;
// [-] 1σ of ln f of such a guess, and of a calibration that came with the log.
constexpr double kGuessSigma = 0.3, kCalibrationSigma = 0.1;
// [m] assumed of a camera above the road until metres tell: between cars and vans.
constexpr double kUsualHeight = 1.5;
// [-] 1σ of principal point, k1 and k2 before the drive: unknown lenses of up to 90°.
constexpr double kCentreSigma = 0.03, kDistortionSigma = 0.3;
// [-] the camera stays as it is: a change of ln f that is small against its 1σ, or at all.
constexpr double kSettledShare = 0.5, kSettled = 5e-4;

/// The windows of one drive with what it recorded.
struct Pass {
  std::vector<CalibrationWindow> windows;
  DriveRecord drive;
};

Pass drive_once(const RunOptions& options) {
  Pass pass;
  WindowCutter cutter;
  pass.drive = run_drive(options, [&](const RunMoment& moment) {
    if (!moment.keyframe) return;
    CalibrationView view{moment.keyframe->T_cam_map, {}};
    for (const KeyframeSighting& seen : moment.keyframe->sightings) {
      view.sightings.push_back({seen.track, project_distorted(moment.record.raw_camera, seen.x)});
    }
    if (auto window = cutter.add(std::move(view))) pass.windows.push_back(std::move(*window));
  });
  pass.windows.push_back(cutter.finish());
  return pass;
}

PinholeCamera camera_of_view(const GreyImage& image, double fov_deg, bool fisheye) {
  PinholeCamera camera;
  camera.width = image.width();
  camera.height = image.height();
  const double half = 0.5 * fov_deg * kDegree;
  camera.fx = camera.fy = 0.5 * image.width() / (fisheye ? half : std::tan(half));
  if (fisheye) camera.lens = LensModel::kannala_brandt;
  camera.cx = 0.5 * (image.width() - 1);
  camera.cy = 0.5 * (image.height() - 1);
  return camera;
}

/// The first frame by any camera at all, when the log has none; by the log's else.
CameraFrame first_frame(const RunOptions& options, bool any_camera) {
  SourceOptions source = options.source.for_log(options.log);
  if (any_camera) source.camera_model = PinholeCamera{};
  RawlogSource log(source);
  const auto ticket = log.next();
  if (!ticket) throw InputError(options.log, "none of its images can be read", "see oneac info");
  return log.load(*ticket);
}

/// The log's camera, or one of the guessed field of view.
Calibration start_of(const CalibrateOptions& options) {
  Calibration start;
  start.prior = {kCalibrationSigma, kCentreSigma, kDistortionSigma, kDistortionSigma};
  start.given_sigma = options.run.front_end.self_calibration.focal_sigma;
  if (!options.fov_deg && !options.fisheye) {
    try {
      start.guess = first_frame(options.run, false).raw_camera;
    } catch (const InputError&) {
      start.guess.fx = 0.0;  // no calibration, most likely; another fault comes again below
    }
    if (start.guess.fx > 0.0) return start;
  }
  start.prior.focal = start.given_sigma = kGuessSigma;
  const double fov_deg =
      options.fov_deg.value_or(options.fisheye ? kUsualFisheye_deg : kUsualFov_deg);
  start.guess = camera_of_view(first_frame(options.run, true).image, fov_deg, options.fisheye);
  return start;
}

/// Measures the windows of a pass that hold a bend.
void measure(const Pass& pass, const PinholeCamera& tracked_with, double min_turn,
             Calibration& calibration) {
  const IntrinsicsVector start = change_between(calibration.guess, tracked_with);
  IntrinsicsBelief belief(calibration.guess, calibration.prior);
  calibration.bends.clear();
  calibration.windows.clear();
  for (const CalibrationWindow& window : pass.windows) {
    if (window.views.empty()) continue;
    calibration.largest_turn = std::max(calibration.largest_turn, turn_of(window));
    if (turn_of(window) < min_turn) continue;
    const auto measured =
        measure_intrinsics(window, calibration.guess, start, calibration.prior, {});
    if (!measured) continue;
    belief.add(*measured);
    calibration.bends.push_back(*measured);
    calibration.windows.push_back(window);
  }
  calibration.turns = turn_evidence(pass.drive);
  std::vector<FocalEvidence> told;
  for (const TurnEvidence& turn : calibration.turns) {
    told.push_back({turn.sensor, start[kFocal] + turn.measured.log_focal, turn.measured.sigma});
  }
  JointEstimate joint = joint_estimate(belief, told);
  calibration.estimate = std::move(joint.estimate);
  calibration.agreeing = std::move(joint.agreeing);
  calibration.contradicting = std::move(joint.contradicting);
}

/// The same drive with its lengths by the road, whatever height of the camera is assumed.
RunOptions by_the_road(RunOptions run) {
  run.front_end.self_calibration.refine = "off";
  run.front_end.self_calibration.check = false;  // done here, with all tracks
  run.front_end.scale.source = "height";
  if (run.front_end.camera_height == 0.0) run.front_end.camera_height = kUsualHeight;
  return run;
}

/// The last pass again with its metres by stereo; empty where the log has none.
std::optional<DriveRecord> drive_by_stereo(RunOptions run) {
  run.front_end.scale.source = "stereo";
  try {
    DriveRecord drive = run_drive(run);
    if (drive.has_scale()) return drive;
  } catch (const InputError&) {
    return std::nullopt;  // no pair, or not rectified
  }
  return std::nullopt;
}

/// @param run  of the last pass
CameraHeight height_of(const Calibration& c, const RunOptions& run) {
  const WayErrors errors{run.front_end.scale.wheel_uncertainty,
                         run.front_end.scale.road_uncertainty};
  const auto by_stereo = c.drive.interrupted ? std::nullopt : drive_by_stereo(run);
  CameraHeight height =
      camera_height_of(c.drive, by_stereo ? &*by_stereo : nullptr, errors, c.focal_sigma());
  // Lengths by the road are as focal length times height.
  const double shorter = c.drive.raw_camera.fx / c.estimate.camera.fx;
  height.metres *= shorter;
  height.assumed *= shorter;
  return height;
}

}  // namespace

double Calibration::focal_sigma() const {
  return knows_focal() ? estimate.sigma(kFocal) : given_sigma;
}

bool Calibration::knows_focal() const {
  const bool confirmed = bends.size() >= IntrinsicsBelief::kFewestWindows || !agreeing.empty();
  return confirmed && estimate.sigma(kFocal) < 0.5 * prior.focal;
}

void CalibrateOptions::validate() {
  run.validate();
  if (run.log.empty()) {
    throw InputError("calibrate", "no rawlog given", "oneac calibrate LOG -o camera.ini");
  }
  if (output.empty()) throw InputError("calibrate", "no output given", "add -o camera.ini");
  const double widest_deg = fisheye ? 220.0 : 150.0;
  if (fov_deg && !(*fov_deg >= 10.0 && *fov_deg <= widest_deg)) {
    throw InputError("--fov-deg " + fixed_text(*fov_deg, 1),
                     "it must be from 10 to " + fixed_text(widest_deg, 0),
                     fisheye ? "" : "a wider lens is a --fisheye");
  }
  if (passes < 1) throw InputError("--passes " + std::to_string(passes), "at least 1", "");
}

Calibration calibrate_camera(const CalibrateOptions& options) {
  Calibration calibration = start_of(options);
  RunOptions run = by_the_road(options.run);
  PinholeCamera camera = calibration.guess;
  for (int i = 0; i < options.passes; ++i) {
    run.camera_model = camera;
    Pass pass = drive_once(run);
    measure(pass, camera, run.front_end.self_calibration.min_turn_deg * kDegree, calibration);
    calibration.drive = std::move(pass.drive);
    ++calibration.passes;
    const double moved = std::abs(std::log(calibration.estimate.camera.fx / camera.fx));
    camera = calibration.estimate.camera;
    const double small = kSettledShare * calibration.estimate.sigma(kFocal);
    if (!calibration.knows_focal() || calibration.drive.interrupted) break;
    if (moved < std::max(small, kSettled)) break;
  }
  calibration.height = height_of(calibration, run);
  return calibration;
}

}  // namespace oneac::app
