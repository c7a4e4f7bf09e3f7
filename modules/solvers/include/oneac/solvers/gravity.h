#pragma once

#include "oneac/geometry/homography.h"
#include "oneac/solvers/relpose_1ac_front_wall.h"
#include "oneac/solvers/relpose_1ac_ground.h"
#include "oneac/solvers/relpose_1ac_planar.h"
#include "oneac/solvers/relpose_1ac_planar_pitch.h"
#include "oneac/solvers/relpose_1ac_side_wall.h"
#include "oneac/solvers/relpose_1ac_wall.h"
#include "oneac/solvers/relpose_1pc_ackermann.h"
#include "oneac/solvers/relpose_2pc_ground.h"
#include "oneac/solvers/relpose_2pc_planar.h"
#include "oneac/solvers/relpose_3pc_vertical.h"

#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <optional>

/// Overloads of the planar solvers for tilted cameras whose vertical direction is known.
///
/// Each takes the direction of gravity in the two camera frames (`down1`, `down2`; any length, (0,
/// 1, 0) for an upright camera), turns the correspondences upright, solves, and turns the pose
/// back. Empty also when a direction has no length or points straight up, or when a point leaves
/// the half-space before its turned camera. Over-determined forms: turn the correspondences once
/// with rotate_views and call the plain functions.
namespace oneac {

/// A solution of the upright cameras and the motion of the tilted ones; units as the solution's.
template <class Solution>
struct TiltedPose {
  Solution upright;     ///< in the upright frames Q1, Q2: normals too
  RelativePose motion;  ///< T_2_1 of the cameras as they are

  [[nodiscard]] RelativePose pose() const { return motion; }
};

/// The smallest rotation that takes `down` to (0, 1, 0); empty when there is none or no unique one.
[[nodiscard]] inline std::optional<Eigen::Matrix3d> upright_rotation(const Eigen::Vector3d& down) {
  const double length = down.norm();
  if (!(length > 1e-12) || !down.allFinite()) return std::nullopt;
  const Eigen::Vector3d g = down / length;
  if (!(g.y() > -1.0 + 1e-9)) return std::nullopt;
  const Eigen::Matrix3d V = cross_matrix(g.cross(Eigen::Vector3d::UnitY()));
  return Eigen::Matrix3d(Eigen::Matrix3d::Identity() + V + V * V / (1.0 + g.y()));
}

namespace internal {

template <class Solution, std::size_t N>
[[nodiscard]] SolutionSet<TiltedPose<Solution>, N> tilt_back(const SolutionSet<Solution, N>& found,
                                                             const Eigen::Matrix3d& Q1,
                                                             const Eigen::Matrix3d& Q2) {
  SolutionSet<TiltedPose<Solution>, N> tilted;
  for (const Solution& solution : found) {
    const RelativePose T = solution.pose();
    tilted.push_back({solution, {Q2.transpose() * T.R * Q1, Q2.transpose() * T.t}});
  }
  return tilted;
}

/// Turns the first `Count` correspondences upright and solves them.
template <std::size_t Count, class Solve>
[[nodiscard]] auto solve_upright(AcSpan acs, const Eigen::Vector3d& down1,
                                 const Eigen::Vector3d& down2, Solve&& solve)
    -> decltype(tilt_back(solve(AcSpan()), Eigen::Matrix3d(), Eigen::Matrix3d())) {
  const auto Q1 = upright_rotation(down1);
  const auto Q2 = upright_rotation(down2);
  if (!Q1 || !Q2 || acs.size() < Count) return {};
  std::array<AffineCorrespondence, Count> upright;
  for (std::size_t i = 0; i < Count; ++i) {
    const auto turned = rotate_views(acs[i], *Q1, *Q2);
    if (!turned) return {};
    upright[i] = *turned;
  }
  return tilt_back(solve(AcSpan(upright.data(), Count)), *Q1, *Q2);
}

}  // namespace internal

[[nodiscard]] inline SolutionSet<TiltedPose<PlanarPose>, 1> relpose_1ac_ground(
    const AffineCorrespondence& ac, const Eigen::Vector3d& down1, const Eigen::Vector3d& down2) {
  return internal::solve_upright<1>(AcSpan(&ac, 1), down1, down2,
                                    [](AcSpan s) { return relpose_nac_ground(s); });
}

[[nodiscard]] inline SolutionSet<TiltedPose<PlanarPose>, 1> relpose_1ac_ground_rapid(
    const AffineCorrespondence& ac, const Eigen::Vector3d& down1, const Eigen::Vector3d& down2) {
  return internal::solve_upright<1>(AcSpan(&ac, 1), down1, down2,
                                    [](AcSpan s) { return relpose_nac_ground_rapid(s); });
}

[[nodiscard]] inline SolutionSet<TiltedPose<WallPose>, 1> relpose_1ac_side_wall(
    const AffineCorrespondence& ac, const Eigen::Vector3d& down1, const Eigen::Vector3d& down2) {
  return internal::solve_upright<1>(AcSpan(&ac, 1), down1, down2,
                                    [](AcSpan s) { return relpose_nac_side_wall(s); });
}

[[nodiscard]] inline SolutionSet<TiltedPose<WallPose>, 1> relpose_1ac_front_wall(
    const AffineCorrespondence& ac, const Eigen::Vector3d& down1, const Eigen::Vector3d& down2) {
  return internal::solve_upright<1>(AcSpan(&ac, 1), down1, down2,
                                    [](AcSpan s) { return relpose_nac_front_wall(s); });
}

[[nodiscard]] inline SolutionSet<TiltedPose<WallPose>, 2> relpose_1ac_wall(
    const AffineCorrespondence& ac, const Eigen::Vector3d& down1, const Eigen::Vector3d& down2) {
  return internal::solve_upright<1>(AcSpan(&ac, 1), down1, down2,
                                    [](AcSpan s) { return relpose_1ac_wall(s[0]); });
}

[[nodiscard]] inline SolutionSet<TiltedPose<PlanarPose>, 1> relpose_1ac_planar(
    const AffineCorrespondence& ac, const Eigen::Vector3d& down1, const Eigen::Vector3d& down2) {
  return internal::solve_upright<1>(AcSpan(&ac, 1), down1, down2,
                                    [](AcSpan s) { return relpose_1ac_planar(s[0]); });
}

[[nodiscard]] inline SolutionSet<TiltedPose<PitchedPose>, 6> relpose_1ac_planar_pitch(
    const AffineCorrespondence& ac, const Eigen::Vector3d& down1, const Eigen::Vector3d& down2,
    double max_pitch = kAnyPitch) {
  return internal::solve_upright<1>(AcSpan(&ac, 1), down1, down2, [max_pitch](AcSpan s) {
    return s.empty() ? SolutionSet<PitchedPose, 6>() : relpose_1ac_planar_pitch(s[0], max_pitch);
  });
}

[[nodiscard]] inline SolutionSet<TiltedPose<PlanarPose>, 1> relpose_1pc_ackermann(
    AcSpan points, const Eigen::Vector3d& down1, const Eigen::Vector3d& down2) {
  return internal::solve_upright<1>(points, down1, down2,
                                    [](AcSpan s) { return relpose_1pc_ackermann(s); });
}

[[nodiscard]] inline SolutionSet<TiltedPose<PlanarPose>, 1> relpose_2pc_ground(
    AcSpan points, const Eigen::Vector3d& down1, const Eigen::Vector3d& down2) {
  return internal::solve_upright<2>(points, down1, down2,
                                    [](AcSpan s) { return relpose_2pc_ground(s); });
}

[[nodiscard]] inline SolutionSet<TiltedPose<PlanarPose>, 2> relpose_2pc_planar(
    AcSpan points, const Eigen::Vector3d& down1, const Eigen::Vector3d& down2) {
  return internal::solve_upright<2>(points, down1, down2,
                                    [](AcSpan s) { return relpose_2pc_planar(s); });
}

[[nodiscard]] inline SolutionSet<TiltedPose<WallPose>, 2> relpose_3pc_vertical(
    AcSpan points, const Eigen::Vector3d& down1, const Eigen::Vector3d& down2) {
  return internal::solve_upright<3>(points, down1, down2,
                                    [](AcSpan s) { return relpose_3pc_vertical(s); });
}

}  // namespace oneac
