#pragma once

#include "oneac/calibration/intrinsics.h"
#include "oneac/geometry/camera.h"

#include <cstddef>
#include <string>
#include <vector>

namespace oneac {

/// What a bend has added to what is known of the camera.
struct CameraMoment {
  std::size_t index = 0;      ///< image of the camera in the log
  double time_s = 0.0;        ///< [s]
  double focal_px = 0.0;      ///< most probable from here on
  double focal_sigma = 0.0;   ///< relative 1σ, what was known before included
  PinholeCamera raw_learned;  ///< see CameraBelief
  IntrinsicsVector sigma = IntrinsicsVector::Zero();
};

/// The camera as given, as used, and as the bends of the drive say that it is.
struct CameraBelief {
  PinholeCamera given;                     ///< of the images as the front-end gets them
  PinholeCamera used;                      ///< from the newest frame on
  double focal_px = 0.0;                   ///< most probable focal length
  double focal_sigma = 0.0;                ///< relative 1σ of it
  double drive_sigma = 0.0;                ///< the same by the drive alone; above 1: it cannot know
  std::size_t bends = 0;                   ///< windows with a bend that were measured
  std::vector<std::string> sensors;        ///< whose turns count, too: "gyroscope", "GPS course"
  std::vector<std::string> contradicting;  ///< whose turns contradict, so that focal_sigma is wide
  double doubt = 0.0;  ///< relative 1σ that lengths by the given one have by what bends say
  /// The next two are of the images as they are stored; else of undistorted ones.
  bool knows_raw = false;
  PinholeCamera raw_used;     ///< from the newest frame on
  PinholeCamera raw_learned;  ///< the same, most probable by bends, its principal point, k1 and k2
  IntrinsicsVector sigma = IntrinsicsVector::Zero();  ///< 1σ of that, without unit
  std::vector<CameraMoment> history;

  /// The drive has made the focal length surer than it was given.
  [[nodiscard]] bool knows_focal() const {
    return (bends > 0 || !sensors.empty()) && drive_sigma < kKnown;
  }

 private:
  static constexpr double kKnown = 0.03;  // no worse than what is taken for granted
};

}  // namespace oneac
