#include "oneac/simulation/simulation_options.h"

#include "oneac/base/require.h"
#include "oneac/geometry/camera_height.h"

#include <cmath>
#include <sstream>
#include <string>

namespace oneac {
namespace {

void require_within(const char* field, double value, double low, double high) {
  std::ostringstream bound;
  bound << "within " << low << " ... " << high;
  require(std::isfinite(value) && value >= low && value <= high,
          std::string("SimulationOptions.") + field, value, bound.str());
}

/// Vehicles are blocks along the axes of the world: along the road they cannot take bends.
void require_straight_for(Traffic traffic, RouteKind route) {
  const bool along = traffic == Traffic::kOvertaking || traffic == Traffic::kOncoming ||
                     traffic == Traffic::kTruck;
  if (!along || route == RouteKind::kStraight || route == RouteKind::kStopAndGo) return;
  throw std::invalid_argument(
      "SimulationOptions.traffic along the road takes no bends: route must be straight or "
      "stop-and-go");
}

/// What tells one lap from the next needs laps; traffic would meet each of them.
void require_block_for_laps(const SimulationOptions& options) {
  if (has_laps(options.route) && options.traffic != Traffic::kNone) {
    throw std::invalid_argument("SimulationOptions.traffic must be none on a block");
  }
  if (options.relight && !has_laps(options.route)) {
    throw std::invalid_argument(
        "SimulationOptions.relight changes laps: route must be block or figure8");
  }
  if (options.lane_shift_m != 0.0 && options.route != RouteKind::kBlock) {
    throw std::invalid_argument("SimulationOptions.lane_shift_m shifts laps: route must be block");
  }
}

}  // namespace

void SimulationOptions::validate() const {
  // The street is built in memory before the first frame, about 2 MB for every second of driving.
  require_within("frames", frames, 1, 10000);
  require_within("width_px", width_px, 16, 4096);
  require_within("height_px", height_px, 16, 4096);
  require_within("focal_px", focal_px, 10.0, 20000.0);
  require_within("fps", fps, 0.5, 200.0);
  require_within("baseline_m", baseline_m, 0.001, 2.0);
  require_within("image_noise", image_noise, 0.0, 50.0);
  require_within("camera_height_m", camera_height_m, CameraHeight::kLowest, CameraHeight::kHighest);
  require_within("camera_forward_m", camera_forward_m, -3.0, 3.0);
  require_within("camera_tilt_deg", camera_tilt_deg, -45.0, 45.0);
  require_within("camera_left_m", camera_left_m, -2.0, 2.0);
  require_within("camera_roll_deg", camera_roll_deg, -180.0, 180.0);
  require_within("camera_yaw_deg", camera_yaw_deg, -180.0, 180.0);
  require_within("speed_mps", speed_mps, 0.5, 40.0);
  require_within("acceleration_mps2", acceleration_mps2, 0.1, 8.0);
  require_within("braking_mps2", braking_mps2, 0.1, 8.0);
  require_within("stop_s", stop_s, 0.0, 600.0);
  require_within("suspension_pitch_deg", suspension_pitch_deg, 0.0, 5.0);
  require_within("suspension_roll_deg", suspension_roll_deg, 0.0, 5.0);
  require_within("slope_percent", slope_percent, -30.0, 30.0);
  require_within("dark_from_s", dark_from_s, 0.0, 1e6);
  require_within("dark_s", dark_s, 0.0, 1e6);
  require_within("gps_noise_m", gps_noise_m, 0.0, 100.0);
  require_within("wheel_error_percent", wheel_error_percent, -50.0, 50.0);
  require_within("truck_gap_m", truck_gap_m, 2.0, 100.0);
  require_within("truck_gap_swing_m", truck_gap_swing_m, 0.0, truck_gap_m - 1.0);
  require_within("bonnet_share", bonnet_share, 0.0, 0.5);
  if (repeat_every != 0) require_within("repeat_every", repeat_every, 2, 1000);
  require_within("rolling_shutter_s", rolling_shutter_s, 0.0, 1.0 / fps);
  // Two bends need 28 m; beyond the left lane stand vehicles.
  require_within("block_m", block_m, 40.0, 1000.0);
  require_within("lane_shift_m", lane_shift_m, 0.0, 3.6);
  require_block_for_laps(*this);
  require_straight_for(traffic, route);
}

}  // namespace oneac
