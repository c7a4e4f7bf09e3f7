#include "oneac/frontend/front_end_options.h"

#include <stdexcept>

namespace oneac {
namespace {

void require(bool good, const std::string& field, const std::string& value, const char* bound) {
  if (!good) throw std::invalid_argument(field + " = " + value + ", must be " + bound);
}

}  // namespace

void TiltOptions::validate() const {
  const bool known = source == "log" || source == "params" || source == "imu" || source == "drive";
  require(known, "tilt.source", source, "log, params, imu or drive");
  require(pitch_up_deg > -45.0 && pitch_up_deg < 45.0, "tilt.pitch_up_deg",
          std::to_string(pitch_up_deg), "between -45 and 45");
  require(roll_right_deg > -45.0 && roll_right_deg < 45.0, "tilt.roll_right_deg",
          std::to_string(roll_right_deg), "between -45 and 45");
  require(prior_steps >= 0, "tilt.prior_steps", std::to_string(prior_steps), "at least 0");
  require(window_steps >= 1, "tilt.window_steps", std::to_string(window_steps), "at least 1");
}

void WindowOptions::validate() const {
  require(size >= 3, "window.size", std::to_string(size), "at least 3");
  require(fixed >= 1 && fixed + 2 <= size, "window.fixed", std::to_string(fixed),
          "from 1 to size - 2");
  require(min_parallax_deg > 0.0, "window.min_parallax_deg", std::to_string(min_parallax_deg),
          "positive");
  require(min_shared >= 0.0 && min_shared <= 1.0, "window.min_shared", std::to_string(min_shared),
          "from 0 to 1");
  require(max_rotation_deg > 0.0, "window.max_rotation_deg", std::to_string(max_rotation_deg),
          "positive");
  require(max_seconds > 0.0, "window.max_seconds", std::to_string(max_seconds), "positive");
  require(min_carry >= 3, "window.min_carry", std::to_string(min_carry), "at least 3");
  require(max_landmarks >= 20, "window.max_landmarks", std::to_string(max_landmarks),
          "at least 20");
  refine.validate();
}

void ScaleOptions::validate() const {
  const bool known =
      source == "height" || source == "stereo" || source == "gps" || source == "none";
  require(known, "scale.source", source, "height, stereo, gps or none");
  require(map_drift > 0.0, "scale.map_drift", std::to_string(map_drift), "positive");
  require(road_uncertainty >= 0.0, "scale.road_uncertainty", std::to_string(road_uncertainty),
          "at least 0");
  require(max_uncertainty > 0.0, "scale.max_uncertainty", std::to_string(max_uncertainty),
          "positive");
  require(outlier_sigmas > 0.0, "scale.outlier_sigmas", std::to_string(outlier_sigmas), "positive");
}

void FrontEndOptions::validate() const {
  require(camera_height >= 0.0 && camera_height < 100.0, "front_end.camera_height",
          std::to_string(camera_height), "from 0 to 100");
  const bool known = mount_convention == "auto" || mount_convention == "optical" ||
                     mount_convention == "x_forward";
  require(known, "front_end.mount_convention", mount_convention, "auto, optical or x_forward");
  if (calibration) calibration->validate();
  require(max_hold >= 0.0, "front_end.max_hold", std::to_string(max_hold), "at least 0");
  tilt.validate();
  features.validate();
  InitialiserOptions{estimator, consensus, gc_ransac}.validate();
  ground_scale.validate();
  refine.validate();
  window.validate();
  scale.validate();
}

}  // namespace oneac
