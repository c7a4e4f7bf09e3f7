#pragma once

#include <Eigen/Core>

#include <optional>

namespace mrpt::obs {
class CObservation;
}

namespace oneac {

/// What a reading beyond is damaged by; no vehicle on a road comes near. Comparisons with NaN are
/// false, so that `within` refuses it too.
struct SensorLimits {
  static constexpr double kFastest = 1e3;       ///< [m/s] speed over ground, from 0
  static constexpr double kAcceleration = 1e3;  ///< [m/s²] of each axis, a hundred times gravity
  static constexpr double kRate = 1e3;          ///< [rad/s] about each axis
  static constexpr double kHighest = 1e5;       ///< [m] above the ellipsoid, either way
  static constexpr double kLatest = 1e11;       ///< [s] Unix time, either way: the year 5138
};

/// One IMU sample in the vehicle's axes.
struct ImuSample {
  double time_s = 0.0;                          ///< Unix time [s]
  std::optional<Eigen::Vector3d> acceleration;  ///< specific force [m/s²]
  std::optional<Eigen::Vector3d> angular_rate;  ///< about x, y, z [rad/s]
};

/// A position on the WGS84 ellipsoid as a receiver tells it.
struct GeodeticFix {
  double latitude_deg = 0.0;   ///< [deg]
  double longitude_deg = 0.0;  ///< [deg]
  double height = 0.0;         ///< [m]
};

/// One message of a GPS receiver, or several of one observation.
struct GpsReading {
  double time_s = 0.0;                  ///< Unix time [s]
  std::optional<GeodeticFix> position;  ///< of a GGA with a fix
  std::optional<double> speed;          ///< over ground, of a valid RMC [m/s]
  std::optional<double> course;         ///< clockwise from north, of a valid RMC [rad]

  [[nodiscard]] bool has_motion() const { return speed || course; }
};

/// The sample of an IMU observation; empty for any other, without time stamp, and when neither
/// accelerations nor rates are there. Fields that are not finite, or beyond SensorLimits, are not.
[[nodiscard]] std::optional<ImuSample> imu_sample(const mrpt::obs::CObservation& observation);

/// The reading of a GPS observation; empty for any other, without time stamp, and when nothing in
/// it is valid. Void fixes and numbers that no vehicle on earth can have are left out.
[[nodiscard]] std::optional<GpsReading> gps_reading(const mrpt::obs::CObservation& observation);

/// Joins the messages of one epoch (GGA and RMC of the same second), which come one by one.
class GpsEpochs {
 public:
  /// What a reading belongs to.
  struct Place {
    double time_s;  ///< of the epoch: that of its first reading
    bool begins;    ///< it begins a new epoch
  };
  /// @param reading  in order of time
  [[nodiscard]] Place add(const GpsReading& reading);

 private:
  std::optional<GpsReading> epoch_;  ///< the last one, as far as known
};

/// A speed over ground at a moment.
struct SpeedReading {
  static constexpr double kDoppler = 0.1;  ///< [m/s] 1σ of a speed that a receiver states

  double time_s = 0.0;      ///< [s] Unix time
  double speed = 0.0;       ///< [m/s]
  double sigma = kDoppler;  ///< [m/s] 1σ
};

/// Speeds over ground out of one receiver's messages: those that it states (RMC), and where an
/// epoch has none, the way between positions (GGA) about a second apart, which holds for the middle
/// of that second. A position that no car gets to is left out, unless the next one confirms it.
class SpeedOverGround {
 public:
  /// @param reading  in order of time
  [[nodiscard]] std::optional<SpeedReading> add(const GpsReading& reading);

 private:
  [[nodiscard]] std::optional<SpeedReading> between_positions(double time_s,
                                                              const GeodeticFix& here);

  struct Place {
    double time_s;
    GeodeticFix position;
  };
  /// Whether a car gets from a place to here.
  [[nodiscard]] bool is_driven(const SpeedReading& told) const;

  GpsEpochs epochs_;
  std::optional<Place> last_;           ///< position that the next is compared with
  std::optional<Place> doubted_;        ///< one after it that no car got to
  std::optional<SpeedReading> driven_;  ///< the last one between positions
  bool stated_ = false;                 ///< a speed came since then
};

}  // namespace oneac
