#pragma once

#include "oneac/geometry/homography.h"
#include "oneac/refine/two_view.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <stdexcept>
#include <vector>

namespace oneac::test {

constexpr double kFocal = 720.0;  // [px]
constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// What the noise of a simulated correspondence is like.
struct Noise {
  double point_px = 0.0;
  double affine = 0.0;
};

struct TwoViewScene {
  RelativePose truth;  ///< |t| = 1
  std::vector<AffineCorrespondence> acs;
};

/// Noise on both points, unlike SceneGenerator::with_noise: the Sampson distance assumes that.
inline AffineCorrespondence disturbed(SceneGenerator& generator, const AffineCorrespondence& ac,
                                      const Noise& noise) {
  AffineCorrespondence noisy = ac;
  for (int i = 0; i < 2; ++i) {
    noisy.x1(i) += generator.normal(noise.point_px / kFocal);
    noisy.x2(i) += generator.normal(noise.point_px / kFocal);
  }
  for (int i = 0; i < 4; ++i) noisy.A(i / 2, i % 2) += generator.normal(noise.affine);
  return noisy;
}

/// A correspondence on some plane that both views see.
inline AffineCorrespondence seen_somewhere(SceneGenerator& generator, const RelativePose& pose) {
  for (int attempt = 0; attempt < 100; ++attempt) {
    try {
      return generator.on_plane(pose, generator.any_plane());
    } catch (const std::runtime_error&) {  // this plane faces away: take the next
    }
  }
  throw std::runtime_error("seen_somewhere: no plane is visible");
}

/// A car's motion with a little pitch and roll; every correspondence on a plane of its own.
inline TwoViewScene street(SceneGenerator& generator, std::size_t count, const Noise& noise) {
  TwoViewScene scene;
  scene.truth = generator.planar_motion();
  scene.truth.R =
      rotation_from_vector({generator.uniform(-0.01, 0.01), 0.0, generator.uniform(-0.01, 0.01)}) *
      scene.truth.R;
  scene.truth.t.normalize();
  while (scene.acs.size() < count) {
    const AffineCorrespondence exact = seen_somewhere(generator, scene.truth);
    scene.acs.push_back(disturbed(generator, exact, noise));
  }
  return scene;
}

/// The truth, turned and its direction changed by about these angles.
inline RelativePose perturbed(SceneGenerator& generator, const RelativePose& truth,
                              double rotation_deg, double direction_deg) {
  const auto vector = [&](double angle_deg) {
    return Eigen::Vector3d(generator.normal(angle_deg * kDegree),
                           generator.normal(angle_deg * kDegree),
                           generator.normal(angle_deg * kDegree));
  };
  const Eigen::Matrix3d R = rotation_from_vector(vector(rotation_deg)) * truth.R;
  return {R, rotation_from_vector(vector(direction_deg)) * truth.t};
}

/// Refines with every correspondence an inlier.
inline RefineResult refine(const test::TwoViewScene& scene, const RelativePose& start,
                           const RefineOptions& options = {}) {
  return refine_two_view(scene.acs, std::vector<bool>(scene.acs.size(), true), start, kFocal,
                         options);
}

inline void expect_same_pose(const RelativePose& a, const RelativePose& b) {
  EXPECT_EQ(a.R, b.R);
  EXPECT_EQ(a.t, b.t);
}

}  // namespace oneac::test
