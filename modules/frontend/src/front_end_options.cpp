#include "oneac/frontend/front_end_options.h"

#include "oneac/base/require.h"
#include "oneac/geometry/camera_height.h"

namespace oneac {
void TiltOptions::validate() const {
  const bool known = source == "log" || source == "params" || source == "imu" || source == "drive";
  require(known, "tilt.source", source, "log, params, imu or drive");
  require(pitch_up_deg > -45.0 && pitch_up_deg < 45.0, "tilt.pitch_up_deg", pitch_up_deg,
          "between -45 and 45");
  require(roll_right_deg > -45.0 && roll_right_deg < 45.0, "tilt.roll_right_deg", roll_right_deg,
          "between -45 and 45");
  require(prior_steps >= 0, "tilt.prior_steps", prior_steps, "at least 0");
  require(window_steps >= 1, "tilt.window_steps", window_steps, "at least 1");
}

void WindowOptions::validate() const {
  require(size >= 3, "window.size", size, "at least 3");
  require(fixed >= 1 && fixed + 2 <= size, "window.fixed", fixed, "from 1 to size - 2");
  require(min_parallax_deg > 0.0, "window.min_parallax_deg", min_parallax_deg, "positive");
  require(min_shared >= 0.0 && min_shared <= 1.0, "window.min_shared", min_shared, "from 0 to 1");
  require(max_rotation_deg > 0.0, "window.max_rotation_deg", max_rotation_deg, "positive");
  require(max_seconds > 0.0, "window.max_seconds", max_seconds, "positive");
  require(min_carry >= 3, "window.min_carry", min_carry, "at least 3");
  require(max_landmarks >= 20, "window.max_landmarks", max_landmarks, "at least 20");
  refine.validate();
}

void ScaleOptions::validate() const {
  const bool known =
      source == "height" || source == "stereo" || source == "gps" || source == "none";
  require(known, "scale.source", source, "height, stereo, gps or none");
  require(map_drift > 0.0, "scale.map_drift", map_drift, "positive");
  require(road_uncertainty >= 0.0, "scale.road_uncertainty", road_uncertainty, "at least 0");
  require(max_uncertainty > 0.0, "scale.max_uncertainty", max_uncertainty, "positive");
  require(outlier_sigmas > 0.0, "scale.outlier_sigmas", outlier_sigmas, "positive");
  require(acceleration > 0.0, "scale.acceleration", acceleration, "positive");
  require(max_acceleration >= acceleration, "scale.max_acceleration", max_acceleration,
          "at least scale.acceleration");
}

void FrontEndOptions::validate() const {
  require(camera_height == 0.0 || CameraHeight::is_plausible(camera_height),
          "front_end.camera_height", camera_height, "0, or from 0.3 to 5 metres");
  const bool known = mount_convention == "auto" || mount_convention == "optical" ||
                     mount_convention == "x_forward";
  require(known, "front_end.mount_convention", mount_convention, "auto, optical or x_forward");
  if (calibration) calibration->validate();
  require(max_hold >= 0.0, "front_end.max_hold", max_hold, "at least 0");
  tilt.validate();
  features.validate();
  InitialiserOptions{estimator, consensus, gc_ransac}.validate();
  ground_scale.validate();
  refine.validate();
  window.validate();
  scale.validate();
}

}  // namespace oneac
