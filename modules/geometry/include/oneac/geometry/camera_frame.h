#pragma once

#include "oneac/base/image.h"
#include "oneac/geometry/camera.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <string>

namespace oneac {

/// One image of one camera with all that the front-end needs to know about it.
struct CameraFrame {
  std::size_t index =
      0;  ///< counts the images of this camera in the log from 0, missing ones included
  double time_s = 0.0;  ///< Unix time [s]
  std::string name;     ///< for messages: file name, or "record N"
  GreyImage image;      ///< rectified
  /// Of the size of `image`: dark (below 128) where it is not used; empty: all of it is.
  GreyImage mask;
  PinholeCamera camera;      ///< of `image`: no distortion left
  PinholeCamera raw_camera;  ///< of the image as it is stored: with its distortion
  GreyImage right;           ///< of a rectified pair, when asked for and there: same `camera`, ...
  double baseline_m = 0.0;   ///< ... so far along the X axis [m]; 0: no pair
  GreyImage right_mask;      ///< of the size of `right`, as `mask`; empty: all of it is used
  /// Camera (optical: X right, Y down, Z forward) in the vehicle frame (X forward,
  /// Y left, Z up) [m].
  Eigen::Isometry3d T_vehicle_cam = forward_looking_mount();
  double decode_ms = 0.0;  ///< CPU time of reading, decoding, undistorting [ms]

  /// A level camera that looks along the vehicle's X axis, at the vehicle's origin.
  [[nodiscard]] static Eigen::Isometry3d forward_looking_mount();
};

}  // namespace oneac
