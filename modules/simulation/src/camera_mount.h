#pragma once

#include "oneac/geometry/camera.h"
#include "oneac/simulation/simulation_options.h"

#include <Eigen/Geometry>

namespace oneac::simulation {

/// The camera of the options: distortion-free, its centre in the middle of the picture.
[[nodiscard]] PinholeCamera camera_of(const SimulationOptions& options);

/// Its mounting: turned to the left by the yaw, then tilted up, then rolled about its axis.
[[nodiscard]] Eigen::Isometry3d mount_of(const SimulationOptions& options);

}  // namespace oneac::simulation
