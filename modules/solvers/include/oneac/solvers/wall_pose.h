#pragma once

#include "oneac/solvers/planar_pose.h"

namespace oneac {

/// Planar motion seen through a vertical plane: t in units of the distance d > 0 between the wall
/// and the first camera, and the wall's normal in the first camera's frame, pointing from the
/// camera to the wall (n·X = d).
struct WallPose : PlanarPose {
  double nx = 0.0;  ///< cos δ
  double nz = 1.0;  ///< sin δ

  /// n of the wall, n·X = d > 0, |n| = 1, in the first camera.
  [[nodiscard]] Eigen::Vector3d normal() const { return {nx, 0.0, nz}; }
};

}  // namespace oneac
