#include "camera_mount.h"

#include "oneac/geometry/angles.h"
#include "oneac/geometry/camera_frame.h"
#include "oneac/geometry/levelling.h"

namespace oneac::simulation {
namespace {}  // namespace

PinholeCamera camera_of(const SimulationOptions& options) {
  PinholeCamera camera;
  camera.width = options.width_px;
  camera.height = options.height_px;
  camera.fx = camera.fy = options.focal_px;
  camera.cx = 0.5 * (options.width_px - 1);
  camera.cy = 0.5 * (options.height_px - 1);
  return camera;
}

Eigen::Isometry3d mount_of(const SimulationOptions& options) {
  const Eigen::AngleAxisd yaw(options.camera_yaw_deg * kDegree, Eigen::Vector3d::UnitZ());
  Eigen::Isometry3d T = CameraFrame::forward_looking_mount();
  T.linear() =
      yaw.toRotationMatrix() * T.linear() *
      levelling_rotation({options.camera_tilt_deg * kDegree, options.camera_roll_deg * kDegree});
  T.translation() << options.camera_forward_m, options.camera_left_m, options.camera_height_m;
  return T;
}

}  // namespace oneac::simulation
