#pragma once

#include "oneac/base/bound.h"

namespace oneac {

/// How loops are looked for. validate() throws std::invalid_argument naming field, value and bound.
struct LoopOptions {
  int features = 700;        ///< SIFT of a keyframe; 190 bytes each are kept for the whole drive
  double driven_m = 30.0;    ///< [m] of way between the two: less is what the window has adjusted;
                             ///< and of way that joins two drives: a shorter stretch repeats itself
  int candidates = 4;        ///< places that look alike and are verified, at most
  int min_inliers = 20;      ///< with a landmark: six unknowns, three times over
  int min_side_inliers = 8;  ///< of them, with a landmark on either side
  double min_share = 0.5;    ///< [-] of correspondences with landmarks: what else is there moves
  double max_position_m = 0.2;    ///< [m] 1σ of the position: five of them are a metre
  double max_rotation_deg = 0.5;  ///< [deg] 1σ: six of them are three degrees
  double noise_px = 0.5;      ///< [px] 1σ of an aligned point between lights, patches and lanes
  int min_support = 2;        ///< other loops near it that say the same
  bool keep_patches = false;  ///< LoopConstraint::patches are filled; no key: of --global-ba

  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

template <class Visitor>
void describe(Visitor&& visit, LoopOptions& o) {
  visit("features", o.features, "count", "SIFT features of a keyframe", Bound::at_least(50));
  visit("driven_m", o.driven_m, "m",
        "way between the two keyframes, at least; and along which two logs are joined",
        Bound::positive());
  visit("candidates", o.candidates, "count", "alike places that are verified, at most",
        Bound::at_least(1));
  visit("min_inliers", o.min_inliers, "count", "inliers with a landmark, at least",
        Bound::at_least(6));
  visit("min_side_inliers", o.min_side_inliers, "count", "of them by either keyframe's landmarks",
        Bound::at_least(3));
  visit("min_share", o.min_share, "-", "inliers of the correspondences with a landmark",
        Bound::from_to(0, 1));
  visit("max_position_m", o.max_position_m, "m", "largest 1-sigma of the position",
        Bound::positive());
  visit("max_rotation_deg", o.max_rotation_deg, "deg", "largest 1-sigma of the rotation",
        Bound::positive());
  visit("noise_px", o.noise_px, "px", "1-sigma of an aligned point", Bound::positive());
  visit("min_support", o.min_support, "count", "loops nearby that say the same, at least",
        Bound::at_least(1));
}

}  // namespace oneac
