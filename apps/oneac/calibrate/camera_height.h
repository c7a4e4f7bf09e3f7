#pragma once

#include "run/drive_record.h"

#include "oneac/calibration/height_measurement.h"

#include <optional>
#include <string>
#include <vector>

namespace oneac::app {

/// What ways in metres by one sensor say of the camera's height.
struct HeightEvidence {
  std::string sensor;  ///< in words
  HeightMeasurement measured;
};

/// What sensors of a log leave in common to all their ways.
struct WayErrors {
  double wheels = 0.03;  ///< relative 1σ, ScaleOptions::wheel_uncertainty
  double road = 0.02;    ///< the same of the road, ScaleOptions::road_uncertainty
};

/// The camera above the road.
struct CameraHeight {
  double metres = 0.0;        ///< [m]; 0: not known
  double assumed = 0.0;       ///< [m] what ratios of the sensors count from
  double length_sigma = 0.0;  ///< relative 1σ of lengths by it and the camera of the drive
  double sigma = 0.0;         ///< relative 1σ of it, the focal length's included
  double by_log = 0.0;        ///< [m] of the log's sensor pose where that contradicts it, else 0
  std::vector<HeightEvidence> sensors;
  std::string reason;  ///< why it is not known, else ""

  [[nodiscard]] bool is_known() const { return metres > 0.0; }
};

/// The height by all that tells metres: speeds or positions of a GPS, the odometry of wheels,
/// another drive over the same images whose lengths are metres by stereo. Straight stretches
/// only, since in bends a camera ahead of the axle goes farther than the sensor.
/// @param drive        over the road, by drive.camera_height
/// @param by_stereo    the same images with lengths by stereo; may be null
/// @param focal_sigma  relative 1σ of the camera's focal length
[[nodiscard]] CameraHeight camera_height_of(const DriveRecord& drive, const DriveRecord* by_stereo,
                                            const WayErrors& errors, double focal_sigma);

}  // namespace oneac::app
