#pragma once

#include "oneac/base/bound.h"
#include "oneac/refine/sliding_window.h"

#include <string>

namespace oneac {

/// Keyframes and the local map. validate() throws std::invalid_argument.
struct WindowOptions {
  bool enabled = true;  ///< off: bare concatenation of two-view poses
  int size = 8;         ///< [keyframes] of the window; older ones are settled and never move again
  int fixed = 2;        ///< [keyframes] the oldest of the window hold position, heading and scale
  double min_parallax_deg = 1.0;  ///< [deg] median parallax that makes a keyframe
  double min_shared = 0.6;        ///< [-] tracks of the last keyframe still alive, else a keyframe
  double max_rotation_deg = 8.0;  ///< [deg] since the last keyframe: a fifth of a usual image
  double max_seconds = 2.0;       ///< [s] between keyframes of a moving camera
  int min_carry = 8;              ///< landmarks that carry the length of a step, at least
  int max_landmarks = 1500;  ///< in one adjustment, longest tracks first: bounds the time, above
                             ///< what the window of a usual drive holds
  WindowRefineOptions refine;
  bool keep_sightings = false;  ///< SettledTracks are collected; no key: the program's --global-ba

  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

template <class Visitor>
void describe(Visitor&& visit, WindowOptions& o) {
  visit("enabled", o.enabled, "bool", "keyframes, local map and sliding-window adjustment");
  visit("size", o.size, "keyframes", "of the window", Bound::at_least(3));
  visit("fixed", o.fixed, "keyframes", "the oldest of the window, which hold the gauge",
        Bound::at_least(1));
  visit("min_parallax_deg", o.min_parallax_deg, "deg", "median parallax that makes a keyframe",
        Bound::positive());
  visit("min_shared", o.min_shared, "-", "share of the last keyframe's tracks below which ...",
        Bound::from_to(0, 1));
  visit("max_rotation_deg", o.max_rotation_deg, "deg", "rotation above which ...",
        Bound::positive());
  visit("max_seconds", o.max_seconds, "s", "time after which a moving camera makes a keyframe",
        Bound::positive());
  visit("min_carry", o.min_carry, "count", "landmarks that carry the length of a step",
        Bound::at_least(3));
  visit("max_landmarks", o.max_landmarks, "count", "in one adjustment, longest tracks first",
        Bound::at_least(20));
  visit.section("refine", o.refine);
}

/// Where metres come from. validate() throws std::invalid_argument.
struct ScaleOptions {
  /// "height": road and camera height; "stereo": the right images' depths; "gps": speeds over
  /// ground; "wheels": those of an odometer; "none"
  std::string source = "height";
  double map_drift = 0.003;        ///< [-] 1σ of the map's scale gained from keyframe to keyframe,
                                   ///< beside that of the lengths its landmarks carry
  double road_uncertainty = 0.02;  ///< [-] 1σ of the height above the road ahead: 3 cm of 1.65 m
                                   ///< for its unevenness and the body on its springs; more
                                   ///< where only road farther than 8 heights is seen
  double wheel_uncertainty = 0.03;  ///< [-] 1σ of the way by wheels that a whole drive shares: wear
                                    ///< (8 mm of 315), pressure and load are 1 to 2 % each
  double max_uncertainty = 0.06;  ///< [-] relative 1σ of the scale that counts as metric
  double outlier_sigmas = 5.0;    ///< [σ] a measurement farther from the map's scale is not
                                  ///< believed; roads are not planes, their errors have long tails

  double acceleration = 3.0;       ///< [m/s²] 1σ of what drivers do: a firm brake is 3 to 4
  double max_acceleration = 12.0;  ///< [m/s²] no tyre on a road gives more: µ g with µ = 1.2

  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

template <class Visitor>
void describe(Visitor&& visit, ScaleOptions& o) {
  visit("source", o.source, "name",
        "height: road and camera height; stereo: right images; gps: speed; wheels: odometer; none",
        Bound::one_of("height, stereo, gps, wheels or none"));
  visit("map_drift", o.map_drift, "-",
        "1-sigma of the map's scale, keyframe to keyframe, beside its landmarks' own",
        Bound::positive());
  visit("road_uncertainty", o.road_uncertainty, "-",
        "1-sigma of the height above the road ahead, the same for metres", Bound::at_least(0));
  visit("wheel_uncertainty", o.wheel_uncertainty, "-",
        "1-sigma of the way by wheels that the whole drive shares, for metres", Bound::at_least(0));
  visit("max_uncertainty", o.max_uncertainty, "-", "relative 1-sigma that counts as metric",
        Bound::positive());
  visit("outlier_sigmas", o.outlier_sigmas, "sigma", "measurements beyond it are left out",
        Bound::positive());
  visit("acceleration", o.acceleration, "m/s^2", "1-sigma of the vehicle's acceleration",
        Bound::positive());
  visit("max_acceleration", o.max_acceleration, "m/s^2", "lengths that need more are not believed",
        Bound::positive());
}

}  // namespace oneac
