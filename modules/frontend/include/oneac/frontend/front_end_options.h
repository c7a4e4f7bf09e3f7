#pragma once

#include "oneac/base/bound.h"
#include "oneac/features/feature_options.h"
#include "oneac/frontend/window_options.h"
#include "oneac/geometry/camera.h"
#include "oneac/initialisers/initialiser_options.h"
#include "oneac/refine/two_view.h"
#include "oneac/robust/ground_scale.h"

#include <cstddef>
#include <optional>
#include <string>

namespace oneac {

/// Where the camera's pitch and roll come from. The planar solvers need them to within a degree.
struct TiltOptions {
  /// "log": sensor pose of the rawlog; "params": the two angles below; "imu": mean accelerometer;
  /// "drive": nothing is given, the drive tells
  std::string source = "log";
  double pitch_up_deg = 0.0;    ///< [deg] optical axis above the horizon, with source "params"
  double roll_right_deg = 0.0;  ///< [deg] camera leaning to its right, with source "params"
  bool refine =
      true;  ///< correct pitch and roll by travel and turns: sensor poses are a degree off
  int prior_steps = 10;    ///< how many steps of driving the given pitch is worth
  int window_steps = 100;  ///< steps whose median direction is used; 10 s at 10 Hz

  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

/// What a drive may find out about its camera. Bends tell a focal length, straight roads do not.
struct SelfCalibrationOptions {
  /// "off": the camera stays as given; "focal": its focal length is learned as the drive goes;
  /// "full": its principal point, k1 and k2 as well, by which correspondences are undistorted
  std::string refine = "off";
  bool check = true;           ///< a drive whose bends contradict the focal length is not metric
  double focal_sigma = 0.03;   ///< [-] relative 1σ of the given focal length: old or resized
  double centre_sigma = 0.02;  ///< [-] 1σ of the principal point in focal lengths: 10 px of 500
  double k1_sigma = 0.05;      ///< [-] 1σ of the given distortion: k1 ...
  double k2_sigma = 0.05;      ///< [-] ... and k2; a twentieth of the radius at 45°
  /// [deg] turn of twelve keyframes that asks them: in less, what a tracker is off by together,
  /// 0.1 px, is more than the focal length's per cent
  double min_turn_deg = 8.0;

  /// Whether bends are looked at.
  [[nodiscard]] bool looks() const { return check || refine != "off"; }
  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

/// Everything the front-end can be told. validate() throws std::invalid_argument naming field,
/// value and bound.
struct FrontEndOptions {
  /// Camera that feed() follows: "LABEL", "LABEL/right", "left", "right"; empty: of the first image
  std::string camera;
  std::string mount_convention = "auto";  ///< of feed()'s sensor poses: auto, optical or x_forward
  std::optional<PinholeCamera> calibration;  ///< of feed()'s images; else their observations'
  double undistorted_fov_deg = 0.0;          ///< of feed()'s images, as of CameraReaderOptions
  std::string initialiser = "1ac_pooled";  ///< method of the relative pose, see initialiser_names()
  double camera_height =
      0.0;  ///< [m] above the road; 0: the height of the log's sensor pose if ≥ 0.5 m
  double max_hold = 2.0;  ///< [s] a step without scale keeps the last metric speed for so long
  SelfCalibrationOptions self_calibration;  ///< key: front_end.calibration
  TiltOptions tilt;
  FeatureOptions features;
  std::string estimator = "default";  ///< robust estimator of the initialiser
  ConsensusOptions consensus;
  GcRansacOptions gc_ransac;
  GroundScaleOptions ground_scale;
  bool perspective = true;     ///< affinities correct tracked points, see correct_perspective()
  bool refine_enabled = true;  ///< two-view bundle adjustment after the consensus
  RefineOptions refine;
  WindowOptions window;
  ScaleOptions scale;
  std::size_t seed = 0;  ///< of initialisers that draw random samples; not a key: run.seed is

  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

template <class Visitor>
void describe(Visitor&& visit, TiltOptions& o) {
  visit("source", o.source, "name",
        "log: sensor pose; params: the angles below; imu: gravity; drive",
        Bound::one_of("log, params, imu or drive"));
  visit("pitch_up_deg", o.pitch_up_deg, "deg", "optical axis above the horizon (source: params)",
        Bound::between(-45, 45));
  visit("roll_right_deg", o.roll_right_deg, "deg", "camera leaning to its right (source: params)",
        Bound::between(-45, 45));
  visit("refine", o.refine, "bool",
        "correct pitch and roll by the directions of travel and turning");
  visit("prior_steps", o.prior_steps, "count", "steps of driving that the given pitch is worth",
        Bound::at_least(0));
  visit("window_steps", o.window_steps, "count", "steps whose median direction is used",
        Bound::at_least(1));
}

template <class Visitor>
void describe(Visitor&& visit, SelfCalibrationOptions& o) {
  visit("refine", o.refine, "name",
        "off: the camera as given; focal: learned from bends and, where the log has them, the "
        "turns of gyroscope and GPS course; full: principal point, k1 and k2 by bends as well",
        Bound::one_of("off, focal or full"));
  visit("check", o.check, "bool", "bends that contradict the focal length take the metres away");
  visit("focal_sigma", o.focal_sigma, "-", "relative 1-sigma of the given focal length",
        Bound::above_to(0, 1));
  visit("centre_sigma", o.centre_sigma, "-", "1-sigma of the principal point, in focal lengths",
        Bound::above_to(0, 1));
  visit("k1_sigma", o.k1_sigma, "-", "1-sigma of the given distortion: k1", Bound::above_to(0, 1));
  visit("k2_sigma", o.k2_sigma, "-", "the same of k2", Bound::above_to(0, 1));
  visit("min_turn_deg", o.min_turn_deg, "deg", "turn within twelve keyframes that is a bend",
        Bound::between(0, 90));
}

template <class Visitor>
void describe(Visitor&& visit, FrontEndOptions& o) {
  visit("initialiser", o.initialiser, "name", "method of the relative pose");
  visit("estimator", o.estimator, "name", "default: the method's own",
        Bound::one_of("default, consensus or gc_ransac"));
  visit("camera_height", o.camera_height, "m", "above the road; 0: from the log if at least 0.5 m");
  visit("max_hold", o.max_hold, "s", "a step without scale keeps the last speed for so long",
        Bound::at_least(0));
  visit("perspective", o.perspective, "bool", "affinities correct tracked points for perspective");
  visit("refine_enabled", o.refine_enabled, "bool", "two-view bundle adjustment of each pair");
  visit.section("calibration", o.self_calibration);
  visit.section("tilt", o.tilt);
  visit.section("features", o.features);
  visit.section("consensus", o.consensus);
  visit.section("gc_ransac", o.gc_ransac);
  visit.section("ground_scale", o.ground_scale);
  visit.section("refine", o.refine);
  visit.section("window", o.window);
  visit.section("scale", o.scale);
}

}  // namespace oneac
