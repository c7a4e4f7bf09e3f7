#include "oneac/test_support/scenes.h"

#include <Eigen/Geometry>

#include <cmath>
#include <stdexcept>

namespace oneac {

double SceneGenerator::uniform(double low, double high) {
  const double unit = static_cast<double>(engine_() >> 11) * 0x1.0p-53;
  return low + (high - low) * unit;
}

double SceneGenerator::normal(double sigma) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(0.0, 1.0)));
  return sigma * radius * std::cos(uniform(0.0, 2.0 * 3.14159265358979323846));
}

RelativePose SceneGenerator::planar_motion() {
  const double alpha = uniform(-0.3, 0.3);
  const double heading = uniform(-1.05, 1.05);
  const double length = uniform(0.2, 2.0);
  // Points move against the camera: driving forward gives t_z < 0.
  return {yaw_rotation(std::cos(alpha), std::sin(alpha)),
          {-length * std::sin(heading), 0.0, -length * std::cos(heading)}};
}

RelativePose SceneGenerator::general_motion() {
  const Eigen::Vector3d axis(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
  const Eigen::Vector3d direction(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
  return {rotation_from_vector(0.17 * axis), uniform(0.2, 2.0) * direction.normalized()};
}

Eigen::Vector2d SceneGenerator::image_point(double low_y, double high_y) {
  const double x = uniform(-0.8, 0.8);
  return {x, uniform(low_y, high_y)};
}

Plane SceneGenerator::ground() {
  return {Eigen::Vector3d::UnitY(), uniform(1.0, 2.0)};
}

Plane SceneGenerator::any_plane() {
  const Eigen::Vector3d n(uniform(-1, 1), uniform(-1, 1), uniform(0.3, 1));
  return {n.normalized(), uniform(3.0, 20.0)};
}

AffineCorrespondence SceneGenerator::on_plane(const RelativePose& T_2_1, const Plane& plane) {
  const Eigen::Matrix3d H = plane_induced_homography(T_2_1, plane);
  for (int attempt = 0; attempt < 1000; ++attempt) {
    const Eigen::Vector2d x1 = image_point();
    const double depth = plane.d / plane.n.dot(x1.homogeneous());
    if (!(depth > 0.5) || depth > 60.0) continue;
    if (!((T_2_1 * (depth * x1.homogeneous())).z() > 0.5)) continue;
    if (const auto ac = correspondence_from_homography(H, x1)) return *ac;
  }
  throw std::runtime_error("SceneGenerator: the plane is not visible");
}

AffineCorrespondence SceneGenerator::with_noise(const AffineCorrespondence& ac, double sigma_point,
                                                double sigma_affine) {
  AffineCorrespondence noisy = ac;
  for (int i = 0; i < 2; ++i) noisy.x2(i) += normal(sigma_point);
  for (int i = 0; i < 4; ++i) noisy.A(i / 2, i % 2) += normal(sigma_affine);
  return noisy;
}

}  // namespace oneac
