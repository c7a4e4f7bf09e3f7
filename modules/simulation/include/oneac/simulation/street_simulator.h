#pragma once

#include "oneac/base/image.h"
#include "oneac/geometry/camera.h"
#include "oneac/simulation/simulation_options.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace oneac {

/// The truth at one instant. World: X east, Y north, Z up, ground at Z = 0 where nothing slopes.
/// Vehicle: X forward, Y left, Z up, origin on the ground. Camera: X right, Y down, Z forward; left
/// one of a stereo pair.
struct SimulatedState {
  double time_s = 0.0;  ///< since the start of the drive [s]
  Eigen::Isometry3d T_world_vehicle = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_world_cam = Eigen::Isometry3d::Identity();
  double speed_mps = 0.0;       ///< along the vehicle's X axis [m/s]
  double yaw_rate_radps = 0.0;  ///< positive to the left [rad/s]
};

/// One image (or stereo pair) with its truth.
struct SimulatedFrame {
  std::size_t index = 0;
  SimulatedState state;
  GreyImage left;
  GreyImage right;  ///< empty without SimulationOptions::stereo
};

/// A GPS fix of the vehicle's origin, with noise.
struct SimulatedGps {
  double time_s = 0.0;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  ///< east, north, up [m]
  double speed_mps = 0.0;                                ///< over ground [m/s]
  double course_deg = 0.0;                               ///< from north, clockwise, [0, 360) [deg]
};

/// A reading of an ideal inertial unit at the vehicle's origin, with a little white noise.
struct SimulatedImu {
  double time_s = 0.0;
  Eigen::Vector3d specific_force_mps2 = Eigen::Vector3d::Zero();  ///< in the vehicle frame
  Eigen::Vector3d angular_rate_radps = Eigen::Vector3d::Zero();   ///< in the vehicle frame
};

/// What the wheels of the vehicle count, at its origin: whole teeth of a ring, with slip under
/// acceleration and the error of SimulationOptions::wheel_error_percent.
struct SimulatedWheels {
  double time_s = 0.0;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  ///< from the start, X ahead there [m]
  double heading_rad = 0.0;                              ///< positive to the left [rad]
};

/// A drive through a made-up town: streets between facades that meet in right-angled bends, walls
/// across at their ends, boxes at the kerb, a stop on every second street, suspension.
///
/// Every function is a pure function of the options (and of its arguments) and may be called from
/// several threads at once; the bytes of a frame do not depend on who asked for what before.
class StreetSimulator {
 public:
  /// Builds the street (some tenths of a second).
  /// @throws std::invalid_argument naming field, value and bound
  explicit StreetSimulator(const SimulationOptions& options);
  ~StreetSimulator();
  StreetSimulator(StreetSimulator&&) noexcept;
  StreetSimulator& operator=(StreetSimulator&&) noexcept;

  /// As given.
  [[nodiscard]] const SimulationOptions& options() const;
  [[nodiscard]] std::size_t size() const;  ///< number of frames
  /// Of the left images, without distortion.
  [[nodiscard]] PinholeCamera camera() const;
  /// The mounting: tilt_from_mounting() of it is the configured tilt.
  [[nodiscard]] Eigen::Isometry3d T_vehicle_cam() const;

  /// @throws std::out_of_range when i is not below size()
  [[nodiscard]] SimulatedState state(std::size_t i) const;
  /// Renders frame i with its noise; some hundredths of a second.
  /// @throws std::out_of_range when i is not below size()
  [[nodiscard]] SimulatedFrame frame(std::size_t i) const;
  /// What a camera at any pose would see at the start of the drive, without noise.
  [[nodiscard]] GreyImage render(const Eigen::Isometry3d& T_world_cam) const;
  /// The point of the world [m] behind a pixel; empty for the sky.
  [[nodiscard]] std::optional<Eigen::Vector3d> surface_point(const Eigen::Isometry3d& T_world_cam,
                                                             const Eigen::Vector2d& u_px) const;

  /// 1 Hz, from the first frame to the epoch at or after the last, so that they cover the drive.
  [[nodiscard]] std::vector<SimulatedGps> gps() const;
  /// 100 Hz, from the first to the last frame.
  [[nodiscard]] std::vector<SimulatedImu> imu() const;
  /// 50 Hz, from the first to the last frame.
  [[nodiscard]] std::vector<SimulatedWheels> wheels() const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace oneac
