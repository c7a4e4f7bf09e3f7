#pragma once

#include "oneac/calibration/intrinsics_belief.h"
#include "oneac/calibration/turn_measurement.h"

#include <string>
#include <vector>

namespace oneac {

/// What another sensor than the images says of a focal length, independent of them.
struct FocalEvidence {
  std::string sensor;      ///< in words
  double log_focal = 0.0;  ///< ln(f / f₀)
  double sigma = 0.0;      ///< 1σ of it, all that is known to be wrong included
};

/// Errors of gyroscopes of phones and cars: scale good to a per cent, turn-on bias of a degree per
/// second. One that is sampled at 10 Hz and more turns by 0.1° wrongly in a bend.
[[nodiscard]] TurnSensor usual_gyroscope();
/// Those of a course of Doppler speeds, 0.05 m/s across 8 m/s; it has neither scale nor bias.
[[nodiscard]] TurnSensor usual_course();

/// Bends and other sensors together.
struct JointEstimate {
  IntrinsicsEstimate estimate;
  std::vector<std::string> agreeing;       ///< sensors that count in it
  std::vector<std::string> contradicting;  ///< those that do not, and widen it

  /// More than one voice says so: two bends, or two sensors.
  [[nodiscard]] bool is_confirmed() const;
};

/// A sensor that says what the bends say, within 3 σ, counts with its own σ. One that contradicts
/// them, a gyroscope of wrong scale, a course that is late, does not count, and nobody knows which
/// of both is wrong: σ of the focal length reaches from one to the other, up to that of the prior.
/// Without two bends, sensors that contradict each other do not count either.
/// @throws std::invalid_argument as IntrinsicsBelief::add_focal
[[nodiscard]] JointEstimate joint_estimate(const IntrinsicsBelief& bends,
                                           const std::vector<FocalEvidence>& told);

}  // namespace oneac
