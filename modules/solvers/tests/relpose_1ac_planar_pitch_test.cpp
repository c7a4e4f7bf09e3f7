#include "oneac/solvers/relpose_1ac_planar_pitch.h"

#include "solver_test_tools.h"

#include "oneac/geometry/essential.h"
#include "oneac/test_support/allocation_counter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace oneac {
namespace {

using namespace test;

struct Case {
  RelativePose T;
  double pitch;
  AffineCorrespondence ac;
};

AffineCorrespondence off_horizon(SceneGenerator& scene, const RelativePose& T) {
  for (;;) {
    AffineCorrespondence ac = scene.on_plane(T, scene.any_plane());
    if (std::abs(ac.x1.y()) > 0.05) return ac;
  }
}

/// A planar motion whose second camera pitches by up to three degrees.
RelativePose pitched(SceneGenerator& scene, double& pitch) {
  pitch = scene.uniform(-0.05, 0.05);
  const RelativePose planar = scene.planar_motion();
  const Eigen::Matrix3d Q = pitch_rotation(pitch);
  return {Q.transpose() * planar.R, Q.transpose() * planar.t};
}

Case pitched_case(SceneGenerator& scene) {
  Case c;
  c.T = pitched(scene, c.pitch);
  c.ac = off_horizon(scene, c.T);
  return c;
}

double equations(const RelativePose& T, const AffineCorrespondence& ac) {
  const Eigen::Matrix3d E = essential_matrix(T);
  return std::abs(ac.x2.homogeneous().dot(E * ac.x1.homogeneous())) +
         affine_epipolar_residual(E, ac).norm();
}

TEST(Relpose1acPlanarPitch, TruthIsAmongTheCandidatesOfThousandScenes) {
  SceneGenerator scene(1);
  int found = 0, nearest_is_not_least_pitch = 0;
  for (int i = 0; i < 1000; ++i) {
    const Case c = pitched_case(scene);
    double least = 10.0, pitch = 10.0, least_pitch = 10.0;
    for (const PitchedPose& pose : relpose_1ac_planar_pitch(c.ac)) {
      if (pose_error(pose.pose(), c.T) < least) pitch = pose.pitch;
      least = std::min(least, pose_error(pose.pose(), c.T));
      if (std::abs(pose.pitch) < std::abs(least_pitch)) least_pitch = pose.pitch;
    }
    found += least < kExact && std::abs(pitch - c.pitch) < kExact ? 1 : 0;
    nearest_is_not_least_pitch += least_pitch == pitch ? 0 : 1;
  }
  EXPECT_GE(found, 999);
  EXPECT_GT(nearest_is_not_least_pitch, 100);  // why all of them are returned
}

TEST(Relpose1acPlanarPitch, SmallTranslationsWithNearlyDoubleRootsKeepTheTruth) {
  SceneGenerator scene(8);
  int found = 0;
  for (int i = 0; i < 1000; ++i) {
    double pitch = 0.0;
    RelativePose T = pitched(scene, pitch);
    T.t *= 0.01;
    const AffineCorrespondence ac = off_horizon(scene, T);
    double least = 10.0;
    for (const PitchedPose& pose : relpose_1ac_planar_pitch(ac)) {
      least = std::min(least, pose_error(pose.pose(), T));
    }
    found += least < 1e-6 ? 1 : 0;  // a hundredth of the translation, a hundredth of the digits
  }
  EXPECT_GE(found, 990);
}

TEST(Relpose1acPlanarPitch, EveryCandidateSatisfiesTheEquationsBeforeBothCameras) {
  SceneGenerator scene(2);
  for (int i = 0; i < 1000; ++i) {
    const Case c = pitched_case(scene);
    for (const PitchedPose& pose : relpose_1ac_planar_pitch(c.ac)) {
      EXPECT_LT(equations(pose.pose(), c.ac), 1e-12) << "scene " << i << " of seed 2";
      EXPECT_NEAR(pose.pose().t.norm(), 1.0, 1e-14);
      const auto point = triangulate_in_front(pose.pose(), c.ac);
      EXPECT_TRUE(point) << "scene " << i << " of seed 2";
    }
  }
}

TEST(Relpose1acPlanarPitch, MaximumPitchOnlyLeavesCandidatesOut) {
  SceneGenerator scene(3);
  for (int i = 0; i < 300; ++i) {
    const Case c = pitched_case(scene);
    std::size_t within = 0;
    for (const PitchedPose& pose : relpose_1ac_planar_pitch(c.ac)) {
      within += std::abs(pose.pitch) <= 0.1 ? 1 : 0;
    }
    EXPECT_EQ(relpose_1ac_planar_pitch(c.ac, 0.1).size(), within) << "scene " << i << " of seed 3";
  }
}

TEST(Relpose1acPlanarPitch, ManyCorrespondencesRecoverTheMotionAndUseWeights) {
  SceneGenerator scene(4);
  for (int i = 0; i < 100; ++i) {
    double pitch = 0.0;
    const RelativePose T = pitched(scene, pitch);
    const int count = 3 + i % 6;
    std::vector<AffineCorrespondence> acs;
    acs.reserve(static_cast<std::size_t>(count) + 1);
    for (int k = 0; k < count; ++k) acs.push_back(off_horizon(scene, T));
    std::vector<double> weights(acs.size(), 1.0);
    acs.push_back(scene.with_noise(acs[0], 0.1, 0.3));
    weights.push_back(0.0);
    const auto found = relpose_nac_planar_pitch(acs, weights.data());
    ASSERT_EQ(found.size(), 1u) << "scene " << i << " of seed 4";
    EXPECT_LT(pose_error(found[0].pose(), T), kExact) << "scene " << i << " of seed 4";
    EXPECT_NEAR(found[0].pitch, pitch, kExact);
  }
}

TEST(Relpose1acPlanarPitch, LeastSquaresIsAMinimumOfTheWeightedEquations) {
  SceneGenerator scene(5);
  double pitch = 0.0;
  const RelativePose T = pitched(scene, pitch);
  std::vector<AffineCorrespondence> acs;
  acs.reserve(12);
  for (int k = 0; k < 12; ++k) acs.push_back(scene.with_noise(off_horizon(scene, T), 1e-3, 1e-2));
  const auto found = relpose_nac_planar_pitch(acs);
  ASSERT_EQ(found.size(), 1u);
  const auto cost = [&acs](const PitchedPose& pose) {
    double sum = 0.0;
    const Eigen::Matrix3d E = essential_matrix(pose.pose());
    for (const auto& ac : acs) {
      sum += std::pow(ac.x2.homogeneous().dot(E * ac.x1.homogeneous()), 2) +
             affine_epipolar_residual(E, ac).squaredNorm();
    }
    return sum;
  };
  const double least = cost(found[0]);
  for (const double step : {-1e-4, 1e-4}) {
    PitchedPose moved = found[0];
    moved.pitch += step;
    EXPECT_GT(cost(moved), least);
    moved = found[0];
    const double c = moved.planar.cos_alpha, s = moved.planar.sin_alpha;
    moved.planar.cos_alpha = c * std::cos(step) - s * std::sin(step);
    moved.planar.sin_alpha = s * std::cos(step) + c * std::sin(step);
    EXPECT_GT(cost(moved), least);
  }
  EXPECT_LT(pose_error(found[0].pose(), T), 0.3);
}

TEST(Relpose1acPlanarPitch, FaultsGiveNothing) {
  SceneGenerator scene(6);
  const Case c = pitched_case(scene);
  for (const Fault& fault : faults(c.ac)) {
    EXPECT_TRUE(relpose_1ac_planar_pitch(fault.ac).empty()) << fault.name;
    EXPECT_TRUE(relpose_nac_planar_pitch(AcSpan(&fault.ac, 1)).empty()) << fault.name;
  }
  for (int i = 0; i < 1000; ++i) {
    const auto turned = pure_rotation(scene.uniform(-0.5, 0.5), scene.image_point());
    EXPECT_TRUE(relpose_1ac_planar_pitch(turned).empty()) << "case " << i << " of seed 6";
    EXPECT_TRUE(relpose_nac_planar_pitch(AcSpan(&turned, 1)).empty());
  }
  EXPECT_TRUE(relpose_nac_planar_pitch(AcSpan()).empty());
}

TEST(Relpose1acPlanarPitch, DoesNotAllocate) {
  SceneGenerator scene(7);
  const Case c = pitched_case(scene);
  const std::size_t before = allocation_count();
  const auto found = relpose_1ac_planar_pitch(c.ac);
  const auto many = relpose_nac_planar_pitch(AcSpan(&c.ac, 1));
  EXPECT_EQ(allocation_count(), before);
  EXPECT_FALSE(found.empty() || many.empty());
}

}  // namespace
}  // namespace oneac
