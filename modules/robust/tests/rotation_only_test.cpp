#include "oneac/robust/rotation_only.h"

#include "oneac/geometry/angular_errors.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oneac {
namespace {

constexpr double kThreshold = 1.0 / 700.0;

std::vector<AffineCorrespondence> rotated_points(SceneGenerator& scene, const Eigen::Matrix3d& R) {
  std::vector<AffineCorrespondence> acs;
  acs.reserve(100);
  for (int i = 0; i < 100; ++i) {
    acs.push_back(scene.on_plane({R, Eigen::Vector3d::Zero()}, scene.any_plane()));
  }
  return acs;
}

TEST(RefineRotation, IsNotMovedByOutliers) {
  SceneGenerator scene(72);
  const Eigen::Matrix3d R = pitch_rotation(0.01);
  auto acs = rotated_points(scene, R);
  for (std::size_t i = 0; i < acs.size(); i += 5) acs[i].x2 = scene.image_point();
  const RotationFit fit = refine_rotation(pitch_rotation(0.007), acs, kThreshold);
  EXPECT_LT(rotation_error(fit.R, R), 1e-4);
}

TEST(MedianTransferError, IsThatOfEvenlySpacedCorrespondences) {
  std::vector<AffineCorrespondence> acs(90);
  for (std::size_t i = 0; i < acs.size(); ++i) acs[i].x2.x() = i % 3 == 0 ? 0.1 : 0.4;
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  EXPECT_DOUBLE_EQ(median_transfer_error(I, acs, 90), 0.4);
  EXPECT_DOUBLE_EQ(median_transfer_error(I, acs, 30), 0.1);
  EXPECT_DOUBLE_EQ(median_transfer_error(I, acs, 1000), 0.4);
}

TEST(RotationTransferErrors, AreZeroForTheTruthAndInfiniteBehindTheCamera) {
  SceneGenerator scene(73);
  const Eigen::Matrix3d R = pitch_rotation(0.02);
  for (double error : rotation_transfer_errors(R, rotated_points(scene, R))) {
    EXPECT_LT(error, 1e-12);
  }
  const std::vector<AffineCorrespondence> one(1);
  EXPECT_TRUE(std::isinf(rotation_transfer_errors(pitch_rotation(3.0), one)[0]));
}

}  // namespace
}  // namespace oneac
