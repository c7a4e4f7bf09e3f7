#pragma once

#include "oneac/geometry/homography.h"
#include "oneac/solvers/registry.h"
#include "oneac/test_support/scenes.h"

#include <cmath>
#include <vector>

namespace oneac::test {

// Scenes that a solver of the list is made for; whoever includes this links oneac::solvers.

inline RelativePose motion_of(const Solver& solver, SceneGenerator& scene) {
  if (solver.motion == SolverMotion::kAny) return scene.general_motion();
  RelativePose T = scene.planar_motion();
  if (solver.motion == SolverMotion::kCircular) {
    const double half = 0.5 * std::atan2(T.R(2, 0), T.R(0, 0));
    T.t = T.t.norm() * Eigen::Vector3d(std::sin(half), 0.0, -std::cos(half));
  }
  if (solver.motion == SolverMotion::kUpright) T.t.y() = scene.uniform(-1.0, 1.0);
  if (solver.motion == SolverMotion::kPitched) {
    const Eigen::Matrix3d Q = pitch_rotation(scene.uniform(-0.05, 0.05));
    T = {Q.transpose() * T.R, Q.transpose() * T.t};
  }
  return T;
}

inline Plane plane_of(const Solver& solver, SceneGenerator& scene) {
  switch (solver.surface) {
    case SolverSurface::kGround:
      return scene.ground();
    case SolverSurface::kSideWall:
      return {Eigen::Vector3d::UnitX(), scene.uniform(2, 6)};
    case SolverSurface::kFrontWall:
      return {Eigen::Vector3d::UnitZ(), scene.uniform(4, 20)};
    case SolverSurface::kWall: {
      const double delta = scene.uniform(0.5, 2.6);
      return {{std::cos(delta), 0.0, std::sin(delta)}, scene.uniform(3, 15)};
    }
    default:
      return scene.any_plane();
  }
}

/// Each correspondence is of a plane of its own.
inline bool on_any_surface(const Solver& solver) {
  return solver.surface == SolverSurface::kAny || solver.surface == SolverSurface::kNoPlane;
}

/// Correspondences that the solver is made for, away from the horizon of both views.
inline std::vector<AffineCorrespondence> correspondences_of(const Solver& solver,
                                                            SceneGenerator& scene,
                                                            const RelativePose& T,
                                                            const Plane& plane) {
  std::vector<AffineCorrespondence> acs;
  while (acs.size() < solver.sample) {
    const Plane& of_this = on_any_surface(solver) ? scene.any_plane() : plane;
    const AffineCorrespondence ac = scene.on_plane(T, of_this);
    if (!(ac.x1.cwiseAbs().minCoeff() > 0.05) || !(ac.x2.cwiseAbs().minCoeff() > 0.05)) continue;
    acs.push_back(ac);
  }
  return acs;
}

}  // namespace oneac::test
