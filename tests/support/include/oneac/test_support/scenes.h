#pragma once

#include "oneac/geometry/affine_correspondence.h"
#include "oneac/geometry/homography.h"
#include "oneac/geometry/relative_pose.h"

#include <cstdint>
#include <random>

namespace oneac {

/// Seeded generator of random but plausible vehicle scenes for property tests.
///
/// The standard distributions differ between libraries, so only the engine is used and mapped here.
class SceneGenerator {
 public:
  explicit SceneGenerator(std::uint64_t seed) : engine_(seed) {}

  [[nodiscard]] double uniform(double low, double high);
  [[nodiscard]] double normal(double sigma);
  /// Planar motion: yaw within ±0.3 rad, translation in the XZ plane of length 0.2 … 2, any heading
  /// within 60° of forward.
  [[nodiscard]] RelativePose planar_motion();
  /// Any motion: rotation up to 0.3 rad about any axis, translation of length 0.2 … 2.
  [[nodiscard]] RelativePose general_motion();
  /// A point of the image, |x| ≤ 0.8, y between the bounds.
  [[nodiscard]] Eigen::Vector2d image_point(double low_y = -0.5, double high_y = 0.5);
  /// The ground n = (0, 1, 0) at a height of 1 … 2.
  [[nodiscard]] Plane ground();
  /// A plane of any normal that faces the camera, 3 … 20 away.
  [[nodiscard]] Plane any_plane();
  /// An exact correspondence of a random visible point of the plane. Tries until one is visible in
  /// both views. @throws std::runtime_error after 1000 tries
  [[nodiscard]] AffineCorrespondence on_plane(const RelativePose& T_2_1, const Plane& plane);
  /// Gaussian noise on x2 (per axis) and on each entry of A.
  [[nodiscard]] AffineCorrespondence with_noise(const AffineCorrespondence& ac, double sigma_point,
                                                double sigma_affine);

 private:
  std::mt19937_64 engine_;
};

}  // namespace oneac
