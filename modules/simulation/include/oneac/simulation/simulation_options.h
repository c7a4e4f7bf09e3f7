#pragma once

#include <cstdint>

namespace oneac {

/// A simulated street drive: how long, which camera, how the vehicle moves.
struct SimulationOptions {
  int frames = 240;        ///< images of the drive; 24 s show bends and a stop
  std::uint64_t seed = 1;  ///< everything random follows from it: street, suspension, noise

  int width_px = 640;        ///< [px] fast to render and to process
  int height_px = 480;       ///< [px]
  double focal_px = 500.0;   ///< [px] 65° across, as usual on vehicles
  double fps = 10.0;         ///< [Hz] KITTI's rate: up to 0.8 m between frames
  bool stereo = false;       ///< render a right image, too
  double baseline_m = 0.12;  ///< [m] right camera on the X axis of the left one; Málaga's rig
  double image_noise = 1.5;  ///< [grey levels] std. deviation; a decent sensor by daylight

  double camera_height_m = 1.5;   ///< [m] above the ground; a car's roof
  double camera_forward_m = 1.0;  ///< [m] in front of the vehicle's origin
  double camera_tilt_deg = 5.0;   ///< [deg] upwards positive; Málaga's camera has 7 to 8

  double speed_mps = 8.0;          ///< [m/s] on straights; a side street
  double acceleration_mps2 = 1.5;  ///< [m/s²] what passengers do not notice
  double braking_mps2 = 2.0;       ///< [m/s²] the same
  double stop_s = 3.0;             ///< [s] length of the stop on every second street; 0: none
  double suspension_pitch_deg =
      0.2;                           ///< [deg] std. deviation at full speed, on top of braking dive
  double suspension_roll_deg = 0.1;  ///< [deg] std. deviation at full speed, on top of cornering

  double slope_percent = 0.0;     ///< [%] of the whole town, rising along the first street
  bool crossing_traffic = false;  ///< a vehicle crosses every street before the camera
  double dark_from_s = 0.0;       ///< [s] from here on, for ...
  double dark_s = 0.0;            ///< [s] ... so long the images are nearly black; 0: never

  double gps_noise_m = 0.3;  ///< [m] std. deviation per axis; a receiver with corrections

  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

}  // namespace oneac
