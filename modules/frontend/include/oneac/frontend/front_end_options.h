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
void describe(Visitor&& visit, FrontEndOptions& o) {
  visit("initialiser", o.initialiser, "name", "method of the relative pose");
  visit("estimator", o.estimator, "name", "default: the method's own",
        Bound::one_of("default, consensus or gc_ransac"));
  visit("camera_height", o.camera_height, "m", "above the road; 0: from the log if at least 0.5 m");
  visit("max_hold", o.max_hold, "s", "a step without scale keeps the last speed for so long",
        Bound::at_least(0));
  visit("perspective", o.perspective, "bool", "affinities correct tracked points for perspective");
  visit("refine_enabled", o.refine_enabled, "bool", "two-view bundle adjustment of each pair");
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
