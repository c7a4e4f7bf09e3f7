#pragma once

#include "oneac/geometry/affine_correspondence.h"
#include "oneac/geometry/angular_errors.h"
#include "oneac/geometry/homography.h"
#include "oneac/geometry/relative_pose.h"
#include "oneac/geometry/triangulation.h"
#include "oneac/solvers/planar_pose.h"
#include "oneac/test_support/scenes.h"

#include <Eigen/Dense>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace oneac::test {

constexpr double kExact = 1e-8;  ///< recovery bound on noise-free scenes [rad]

/// Largest of the rotation and the translation-direction error [rad].
inline double pose_error(const RelativePose& estimate, const RelativePose& truth) {
  return std::max(rotation_error(estimate.R, truth.R), direction_error(estimate.t, truth.t));
}

/// The motion with its length in units of `length`.
inline RelativePose in_units(const RelativePose& T, double length) {
  return {T.R, T.t / length};
}

inline double cos_of(const RelativePose& T) {
  return T.R(0, 0);
}
inline double sin_of(const RelativePose& T) {
  return T.R(2, 0);
}

/// A fault that no solver may turn into a pose.
struct Fault {
  std::string name;
  AffineCorrespondence ac;
};

/// Not finite, zero, mirrored or motionless correspondences around an ordinary one.
inline std::vector<Fault> faults(const AffineCorrespondence& good) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  std::vector<Fault> list;
  for (const double bad : {nan, inf, -inf}) {
    for (int i = 0; i < 8; ++i) {
      AffineCorrespondence ac = good;
      if (i < 2) ac.x1(i) = bad;
      if (i >= 2 && i < 4) ac.x2(i - 2) = bad;
      if (i >= 4) ac.A((i - 4) / 2, i % 2) = bad;
      list.push_back({"entry " + std::to_string(i) + " = " + std::to_string(bad), ac});
    }
  }
  list.push_back({"all zero", {{0, 0}, {0, 0}, Eigen::Matrix2d::Zero()}});
  list.push_back({"zero affinity", {good.x1, good.x2, Eigen::Matrix2d::Zero()}});
  AffineCorrespondence mirrored = good;
  mirrored.A.col(0) = -mirrored.A.col(0);
  list.push_back({"reflection", mirrored});
  list.push_back({"no motion", {good.x1, good.x1, Eigen::Matrix2d::Identity()}});
  return list;
}

/// Numbers of any size that a double holds without overflow in products of three.
inline AffineCorrespondence extreme_correspondence(SceneGenerator& scene) {
  const auto wild = [&scene] { return scene.normal(1.0) * std::pow(10.0, scene.uniform(-80, 80)); };
  AffineCorrespondence ac;
  ac.x1 = {wild(), wild()};
  ac.x2 = {wild(), wild()};
  ac.A << wild(), wild(), wild(), wild();
  return ac;
}

/// What a camera sees that only turns: pure yaw, of any scene.
inline AffineCorrespondence pure_rotation(double alpha, const Eigen::Vector2d& x1) {
  return *correspondence_from_homography(yaw_rotation(std::cos(alpha), std::sin(alpha)), x1);
}

/// `ac` whose point sits on the horizon y = 0 of a plane, exactly.
inline AffineCorrespondence on_horizon(const RelativePose& T, const Plane& plane, double x) {
  return *correspondence_from_homography(plane_induced_homography(T, plane), {x, 0.0});
}

/// Whether the pair lies before both cameras.
inline bool triangulate_in_front(const RelativePose& T, const AffineCorrespondence& ac) {
  const auto point = triangulate(T, ac.x1, ac.x2);
  return point && point->in_front();
}

}  // namespace oneac::test
