#pragma once

#include "oneac/features/correspondence.h"
#include "oneac/frontend/tilt_belief.h"
#include "oneac/geometry/affine_correspondence.h"
#include "oneac/geometry/relative_pose.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace oneac {

/// Who told a length.
enum class LengthSource {
  kNone,       ///< nobody
  kStanding,   ///< the camera did not travel: zero metres
  kMap,        ///< landmarks carry the length of the map
  kRoad,       ///< the road, by the camera's height: its corners
  kRoadImage,  ///< the same by its grey values
  kStereo,     ///< depths by the right images
  kSpeed,      ///< speeds over ground
  kHeld,       ///< the last speed goes on
};

/// The length of one step.
struct LengthMeasurement {
  double length = 0.0;  ///< [m]; by landmarks [map]
  double sigma = 0.0;   ///< relative 1σ
  LengthSource source = LengthSource::kNone;
  std::size_t support = 0;  ///< landmarks, or correspondences on the road
  double reach = 0.0;       ///< [heights] how far ahead the road is that tells it
  double turn_sigma = 0.0;  ///< [m or map] 1σ beside it, by the turn: of this step alone
};

/// How far the camera went in a step, measured in that step alone: by the grey values of the road
/// or by depths of stereo. Zero is a measurement, too.
struct MeasuredTravel {
  double length = 0.0;  ///< [m], or [camera heights] where the height is not known
  double sigma = 0.0;   ///< 1σ, in the same unit
  LengthSource source = LengthSource::kRoadImage;
  bool in_metres = false;
  double reach = 0.0;           ///< [heights] how far ahead the road is that tells it
  AngleBelief roll_right = {};  ///< [rad] of the camera against that road; σ 0: not seen
};

/// True length over length in the map.
struct ScaleMeasurement {
  double ratio = 0.0;
  double sigma = 0.0;  ///< relative 1σ
  LengthSource source = LengthSource::kNone;
  std::size_t support = 0;
  double reach = 0.0;  ///< [heights] how far ahead the road is that tells it
};

/// What a step's length comes to.
struct StepLength {
  double length = 0.0;   ///< [m, or units while the drive has no scale] as used in the trajectory
  double sigma = 0.0;    ///< relative 1σ of a metric length, else 0
  double sigma_m = 0.0;  ///< [m] the same of a metric length, absolute: of a rest, too
  bool metric = false;
  LengthSource source = LengthSource::kNone;  ///< whose word it is
  bool conflict = false;                      ///< road and map contradict each other
  bool refused = false;                       ///< somebody told metres that inertia does not allow
  bool too_fast = false;                      ///< somebody told more than any car drives
  bool beside_stamps = false;                 ///< two agree on it, whatever inertia says
  double camera_doubt = 0.0;                  ///< relative 1σ, part of sigma, by the camera
  std::optional<MeasuredTravel> without_inertia;  ///< the measurement alone, where inertia helped
  std::size_t landmarks = 0;                      ///< that carried it
  std::size_t ground_acs = 0;                     ///< on the road, where it was asked
};

/// The same where images, road and inertia contradict each other: one of them is wrong, or the
/// stamps are, and nothing says which.
[[nodiscard]] inline StepLength without_metres(StepLength length) {
  length.metric = false;
  length.sigma = length.sigma_m = 0.0;
  return length;
}

/// Two views of the same tracks.
struct KeyframePair {
  std::vector<AffineCorrespondence> acs;  ///< normalised
  RelativePose T_2_1;                     ///< in lengths of the map
};

/// A landmark's depth in the map beside one that was measured otherwise.
struct DepthComparison {
  double in_map = 0.0;        ///< [map]
  double in_map_sigma = 0.0;  ///< relative 1σ
  MeasuredDepth measured;
};

/// What the map's newest lengths can be compared with, at a new keyframe.
struct MapLengths {
  KeyframePair newest;                  ///< the last keyframe but one and the last
  std::vector<DepthComparison> depths;  ///< in the last
};

/// What a keyframe changes in the scale of the map.
struct ScaleCorrection {
  double share = 1.0;   ///< how far it speaks for the lengths before, see ScaleFilter::drift()
  double factor = 1.0;  ///< all lengths of the map are to be multiplied by it
  bool metric = false;  ///< of the map, from now on
  double sigma = 0.0;   ///< relative 1σ of its lengths; infinite while nobody has measured
  std::size_t ground_acs = 0;  ///< on the road, where it was asked
};

}  // namespace oneac
