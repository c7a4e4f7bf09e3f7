#pragma once

#include "solver_test_tools.h"

#include "oneac/geometry/essential.h"
#include "oneac/solvers/span.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace oneac::test {

/// Correspondences of a general scene: each on a plane of its own.
inline std::vector<AffineCorrespondence> scattered(SceneGenerator& scene, const RelativePose& T,
                                                   int count) {
  std::vector<AffineCorrespondence> acs;
  while (static_cast<int>(acs.size()) < count) {
    const AffineCorrespondence ac = scene.on_plane(T, scene.any_plane());
    if (std::abs(ac.x1.y()) > 0.02 && std::abs(ac.x2.y()) > 0.02) acs.push_back(ac);
  }
  return acs;
}

/// A point of the first camera's frame in both views, without an affinity of its own.
inline AffineCorrespondence in_both_views(const RelativePose& T, const Eigen::Vector3d& X1) {
  return {X1.hnormalized(), (T * X1).hnormalized(), Eigen::Matrix2d::Identity()};
}

/// Along a circle, turning by alpha [rad], forwards where the length of the chord is positive.
inline RelativePose circular_motion(double alpha, double length) {
  return {yaw_rotation(std::cos(alpha), std::sin(alpha)),
          length * Eigen::Vector3d(std::sin(alpha / 2), 0.0, -std::cos(alpha / 2))};
}

inline std::vector<AffineCorrespondence> on_one_plane(SceneGenerator& scene, const RelativePose& T,
                                                      const Plane& plane, int count) {
  std::vector<AffineCorrespondence> acs;
  while (static_cast<int>(acs.size()) < count) {
    const AffineCorrespondence ac = scene.on_plane(T, plane);
    if (std::abs(ac.x1.y()) > 0.02 && std::abs(ac.x2.y()) > 0.02) acs.push_back(ac);
  }
  return acs;
}

/// The same points seen by a camera that only turned.
inline std::vector<AffineCorrespondence> turned(SceneGenerator& scene, int count) {
  const double alpha = scene.uniform(-0.3, 0.3);
  std::vector<AffineCorrespondence> acs;
  acs.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) acs.push_back(pure_rotation(alpha, scene.image_point()));
  return acs;
}

/// |E − λ E_truth| for unit norms, sign free.
inline double essential_error(const Eigen::Matrix3d& E, const Eigen::Matrix3d& truth) {
  const Eigen::Matrix3d a = E.normalized(), b = truth.normalized();
  return std::min((a - b).norm(), (a + b).norm());
}

template <class Poses>
double nearest_pose(const Poses& poses, const RelativePose& T) {
  double least = 10.0;
  for (const auto& pose : poses) least = std::min(least, pose_error(pose.pose(), T));
  return least;
}

/// Runs a solver on broken inputs of `count` correspondences; each must give nothing.
template <class Solver>
void expect_nothing_from_broken_points(const std::vector<AffineCorrespondence>& good,
                                       Solver&& solver) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    for (int i = 0; i < 4; ++i) {
      auto acs = good;
      (i < 2 ? acs[0].x1 : acs[0].x2)(i % 2) = bad;
      EXPECT_TRUE(solver(AcSpan(acs)).empty()) << "entry " << i << " = " << bad;
    }
  }
  const std::vector<AffineCorrespondence> zero(good.size());
  EXPECT_TRUE(solver(AcSpan(zero)).empty()) << "all zero";
  const std::vector<AffineCorrespondence> same(good.size(), good[0]);
  EXPECT_TRUE(good.size() == 1 || solver(AcSpan(same)).empty()) << "coincident";
  auto still = good;
  for (auto& ac : still) ac.x2 = ac.x1;
  EXPECT_TRUE(solver(AcSpan(still)).empty()) << "no motion";
  EXPECT_TRUE(solver(AcSpan()).empty()) << "no input";
  EXPECT_TRUE(good.size() == 1 || solver(AcSpan(good.data(), good.size() - 1)).empty())
      << "one few";
}

}  // namespace oneac::test
