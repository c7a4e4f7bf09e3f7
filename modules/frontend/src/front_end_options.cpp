#include "oneac/frontend/front_end_options.h"

#include "oneac/base/check_bounds.h"
#include "oneac/base/require.h"
#include "oneac/geometry/camera_height.h"

namespace oneac {
void TiltOptions::validate() const {
  check_bounds("tilt", *this);
}

void WindowOptions::validate() const {
  check_bounds("window", *this);
  require(fixed + 2 <= size, "window.fixed", fixed, "from 1 to size - 2");
  refine.validate();
}

void ScaleOptions::validate() const {
  check_bounds("scale", *this);
  require(max_acceleration >= acceleration, "scale.max_acceleration", max_acceleration,
          "at least scale.acceleration");
}

void SelfCalibrationOptions::validate() const {
  check_bounds("front_end.calibration", *this);
}

void FrontEndOptions::validate() const {
  check_bounds("front_end", *this);
  require(camera_height == 0.0 || CameraHeight::is_plausible(camera_height),
          "front_end.camera_height", camera_height, "0, or from 0.3 to 5 metres");
  const bool known = mount_convention == "auto" || mount_convention == "optical" ||
                     mount_convention == "x_forward";
  require(known, "front_end.mount_convention", mount_convention, "auto, optical or x_forward");
  if (calibration) calibration->validate();
  require(
      undistorted_fov_deg == 0.0 || (undistorted_fov_deg >= 10.0 && undistorted_fov_deg <= 150.0),
      "front_end.undistorted_fov_deg", undistorted_fov_deg, "0, or from 10 to 150 degrees");
  self_calibration.validate();
  tilt.validate();
  features.validate();
  InitialiserOptions{estimator, consensus, gc_ransac}.validate();
  ground_scale.validate();
  refine.validate();
  window.validate();
  scale.validate();
}

}  // namespace oneac
