#pragma once

#include <cstdint>

namespace oneac {

/// Where the vehicle drives.
enum class RouteKind {
  kStreet,      ///< streets between right-angled bends, a stop on every second one
  kStraight,    ///< one road without bend, a stop after 30 m
  kStopAndGo,   ///< the same, with a stop of 1 to 3.5 s every 10 to 22 m
  kRoundabout,  ///< streets that meet in roundabouts, taken with 120 to 210 degrees of circle
  kBlock,       ///< round a square block to the left, lap after lap, without a stop
  kFigure8,     ///< round one block to the left and the one across the junction to the right
};
/// Whether the route comes back to where it began, again and again.
[[nodiscard]] constexpr bool has_laps(RouteKind route) {
  return route == RouteKind::kBlock || route == RouteKind::kFigure8;
}
/// What stands around the road.
enum class Scenery {
  kTown,  ///< facades, parked vehicles and posts, a plain sky
  kFar,   ///< open land: houses beyond 110 m, a cloudy sky, a lamp post now and then
};
/// What the road shows.
enum class RoadSurface {
  kTextured,  ///< stones, cracks, repairs, paving, markings
  kDark,      ///< dull and nearly black, faint markings: wet asphalt under clouds
  kDashes,    ///< smooth, with markings and nothing else
  kSlabs,     ///< paved with slabs of 0.6 m that all look alike
  kWet,       ///< puddles and a film of water, in which everything above the road is seen again
};
/// What moves beside the vehicle.
enum class Traffic {
  kNone,
  kCrossing,    ///< a vehicle crosses every street before the camera
  kOvertaking,  ///< vehicles pass on the left lane
  kOncoming,    ///< vehicles come towards the camera on the left lane
  kTruck,       ///< a truck with a lettered rear drives ahead on the same lane
  kBus,         ///< buses cross close before the camera while it stands
};

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
  double camera_left_m = 0.0;     ///< [m] left of the vehicle's middle
  double camera_tilt_deg = 5.0;   ///< [deg] upwards positive; Málaga's camera has 7 to 8
  double camera_roll_deg = 0.0;   ///< [deg] right side down positive; 180: upside down
  double camera_yaw_deg = 0.0;    ///< [deg] to the left positive; 180: looks back

  double speed_mps = 8.0;          ///< [m/s] on straights; a side street
  double acceleration_mps2 = 1.5;  ///< [m/s²] what passengers do not notice
  double braking_mps2 = 2.0;       ///< [m/s²] the same
  double stop_s =
      3.0;  ///< [s] length of the stop on every second street, on a straight road; 0: none
  double suspension_pitch_deg =
      0.2;                           ///< [deg] std. deviation at full speed, on top of braking dive
  double suspension_roll_deg = 0.1;  ///< [deg] std. deviation at full speed, on top of cornering

  RouteKind route = RouteKind::kStreet;
  double block_m = 120.0;     ///< [m] side of the block; a block of a grid of streets
  double lane_shift_m = 0.0;  ///< [m] every second lap of the block drives so far to the left
  bool relight = false;       ///< every second lap: the sun elsewhere, other parked vehicles
  bool alike = false;  ///< every facade the same, every street laid out as the first: places that
                       ///< nothing tells apart
  Scenery scenery = Scenery::kTown;
  RoadSurface road = RoadSurface::kTextured;
  Traffic traffic = Traffic::kNone;  ///< most need a route without bends; a block has none
  double truck_gap_m = 7.0;          ///< [m] from the camera to the truck; close city traffic
  double truck_gap_swing_m = 0.0;    ///< [m] the gap swings by so much in 12 s; 0: constant

  double slope_percent = 0.0;  ///< [%] of the whole town, rising along the first street
  double dark_from_s = 0.0;    ///< [s] from here on, for ...
  double dark_s = 0.0;         ///< [s] ... so long the images are nearly black; 0: never

  double bonnet_share = 0.0;    ///< [-] of the picture's height that the bonnet hides; 0: none
  bool rain = false;            ///< drops on the windscreen, less contrast
  bool wiper = false;           ///< a blade sweeps the picture and takes the drops along
  bool exposure_jumps = false;  ///< another exposure every 1.1 s, from a third to nearly double
  bool night = false;           ///< headlights, an amplified sensor: noise and hot pixels
  /// [images] every so many-th shows the one before once more, with noise of its own, as in a video
  /// of a slower camera that was brought to `fps`; 0: never
  int repeat_every = 0;
  double rolling_shutter_s = 0.0;  ///< [s] from the first row, the pose's moment, to the last

  double gps_noise_m = 0.3;          ///< [m] std. deviation per axis; a receiver with corrections
  double wheel_error_percent = 0.0;  ///< [%] by which the odometer counts too long a way

  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

}  // namespace oneac
