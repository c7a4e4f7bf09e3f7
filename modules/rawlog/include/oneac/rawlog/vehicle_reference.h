#pragma once

#include "oneac/observations/sensor_readings.h"

#include <Eigen/Core>

#include <filesystem>
#include <optional>
#include <vector>

namespace oneac {

/// One GPS epoch: GGA and RMC of the same second merged. Fields that were not in the log are empty.
struct GpsFix {
  double time_s = 0.0;                          ///< Unix time, as stamped in the log [s]
  std::optional<Eigen::Vector3d> position_enu;  ///< east, north, up from the first fix [m]
  std::optional<double> speed;                  ///< over ground [m/s]
  std::optional<double> course;                 ///< direction of travel, clockwise from north [rad]
};

/// Where on the earth a receiver was, and which way it went.
struct EarthPlace {
  /// Earth-centred, on the WGS84 ellipsoid, since receivers disagree on heights [m].
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  std::optional<double> course;  ///< clockwise from north [rad]; none of one that hardly moved
};

/// What the other sensors say about the vehicle's motion: a reference, not an input.
struct VehicleReference {
  std::vector<GpsFix> gps;            ///< in time order, NaN-free
  std::optional<GeodeticFix> origin;  ///< of their positions: the first
  /// Of the same receiver, by its positions where it states none; in time order.
  std::vector<SpeedReading> speeds;
  std::vector<ImuSample> imu;  ///< in time order

  /// Change of course (RMC) from t0 to t1, counter-clockwise positive, unwrapped [rad]; empty
  /// without two courses that cover the interval to within 1.5 s.
  [[nodiscard]] std::optional<double> heading_change(double t0, double t1) const;
  /// Speed integrated over [t0, t1] by the trapezium rule [m]; empty when speeds do not cover it.
  [[nodiscard]] std::optional<double> distance(double t0, double t1) const;
  /// By the positions around t, which are 5 s apart at most.
  [[nodiscard]] std::optional<EarthPlace> place(double t) const;
};

/// What GPS and IMU say over a whole log, images passed over; of a damaged log what can be read.
/// @throws InputError (no such file, not a rawlog)
[[nodiscard]] VehicleReference read_vehicle_reference(const std::filesystem::path& log);

}  // namespace oneac
