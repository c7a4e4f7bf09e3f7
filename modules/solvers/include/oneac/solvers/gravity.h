#pragma once

#include "oneac/geometry/homography.h"
#include "oneac/geometry/relative_pose.h"
#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"

#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <optional>

/// Planar solvers for tilted cameras whose vertical direction is known.
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

}  // namespace internal

/// Runs a planar solver for tilted cameras: turns the first `kSample` correspondences upright,
/// solves, and turns the poses back. Over-determined forms: turn the correspondences once with
/// rotate_views and call the solver itself.
/// @param down1, down2  gravity in the two camera frames; any length, (0, 1, 0) for an upright one
/// @param solve         from kSample correspondences (AcSpan) to a SolutionSet of planar poses
/// @return              empty also when a direction has no length or points straight up, or when a
///                      point leaves the half-space before its turned camera
template <std::size_t kSample, class Solve>
[[nodiscard]] auto solve_tilted(AcSpan acs, const Eigen::Vector3d& down1,
                                const Eigen::Vector3d& down2, Solve&& solve)
    -> decltype(internal::tilt_back(solve(AcSpan()), Eigen::Matrix3d(), Eigen::Matrix3d())) {
  const auto Q1 = upright_rotation(down1);
  const auto Q2 = upright_rotation(down2);
  if (!Q1 || !Q2 || acs.size() < kSample) return {};
  std::array<AffineCorrespondence, kSample> upright;
  for (std::size_t i = 0; i < kSample; ++i) {
    const auto turned = rotate_views(acs[i], *Q1, *Q2);
    if (!turned) return {};
    upright[i] = *turned;
  }
  return internal::tilt_back(solve(AcSpan(upright.data(), kSample)), *Q1, *Q2);
}

/// The same of one correspondence; `solve` takes the correspondence itself.
template <class Solve>
[[nodiscard]] auto solve_tilted(const AffineCorrespondence& ac, const Eigen::Vector3d& down1,
                                const Eigen::Vector3d& down2, Solve&& solve)
    -> decltype(internal::tilt_back(solve(ac), Eigen::Matrix3d(), Eigen::Matrix3d())) {
  return solve_tilted<1>(AcSpan(&ac, 1), down1, down2, [&solve](AcSpan s) { return solve(s[0]); });
}

}  // namespace oneac
