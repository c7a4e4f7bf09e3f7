#include "oneac/solvers/relpose_2ac.h"

#include "point_solver_tools.h"

#include "oneac/solvers/essential_5pc.h"
#include "oneac/test_support/allocation_counter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace oneac {
namespace {

using namespace test;

constexpr double kPatchRadius = 0.02;  // weight of the affine equations

double nearest(const SolutionSet<RelativePose, 4>& poses, const RelativePose& T) {
  double least = 10.0;
  for (const RelativePose& pose : poses) least = std::min(least, pose_error(pose, T));
  return least;
}

double equations(const RelativePose& T, const AffineCorrespondence& ac) {
  const Eigen::Matrix3d E = essential_matrix(T);
  return std::abs(ac.x2.homogeneous().dot(E * ac.x1.homogeneous())) +
         affine_epipolar_residual(E, ac).norm();
}

TEST(Relpose2ac, RecoversThousandScenesOfAnyMotion) {
  SceneGenerator scene(1);
  int missed = 0;
  for (int i = 0; i < 1000; ++i) {
    const RelativePose T = scene.general_motion();
    missed += nearest(relpose_2ac(scattered(scene, T, 2)), T) < kExact ? 0 : 1;
  }
  EXPECT_LE(missed, 1);
}

TEST(Relpose2ac, RecoversPlanarAndShortMotions) {
  SceneGenerator scene(2);
  int missed = 0;
  for (int i = 0; i < 1000; ++i) {
    RelativePose T = i % 2 == 0 ? scene.planar_motion() : scene.general_motion();
    if (i % 2 != 0) T.t *= 0.01;
    missed += nearest(relpose_2ac(scattered(scene, T, 2)), T) < 1e-6 ? 0 : 1;
  }
  EXPECT_LE(missed, 8);
}

TEST(Relpose2ac, OnOnePlaneTheTruthIsOneOfTwo) {
  SceneGenerator scene(3);
  int found = 0;
  double solutions = 0.0;
  for (int i = 0; i < 500; ++i) {
    const RelativePose T = scene.general_motion();
    const auto poses = relpose_2ac(on_one_plane(scene, T, scene.any_plane(), 2));
    found += nearest(poses, T) < 1e-6 ? 1 : 0;
    solutions += static_cast<double>(poses.size());
  }
  EXPECT_GE(found, 450);
  EXPECT_GT(solutions, 700.0);  // a plane has two motions
}

TEST(Relpose2ac, EverySolutionObeysAllSixEquationsBeforeBothCameras) {
  SceneGenerator scene(4);
  for (int i = 0; i < 500; ++i) {
    const RelativePose T = scene.general_motion();
    const auto acs = scattered(scene, T, 2);
    for (const RelativePose& pose : relpose_2ac(acs)) {
      for (const auto& ac : acs) {
        EXPECT_LT(equations(pose, ac), 1e-7) << "scene " << i << " of seed 4";
        EXPECT_TRUE(triangulate_in_front(pose, ac)) << "scene " << i << " of seed 4";
      }
      EXPECT_NEAR(pose.t.norm(), 1.0, 1e-12);
      EXPECT_NEAR((pose.R * pose.R.transpose() - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-12);
    }
  }
}

TEST(Relpose2ac, AgreesWithTheFivePointSolver) {
  SceneGenerator scene(5);
  int agree = 0;
  for (int i = 0; i < 300; ++i) {
    const RelativePose T = scene.general_motion();
    const auto acs = scattered(scene, T, 5);
    const auto two = relpose_2ac(acs);
    double least = 10.0;
    for (const RelativePose& pose : two) {
      for (const Eigen::Matrix3d& E : essential_5pc(acs)) {
        least = std::min(least, essential_error(E, essential_matrix(pose)));
      }
    }
    agree += least < 1e-7 ? 1 : 0;
  }
  EXPECT_GE(agree, 298);
}

TEST(Relpose2ac, NoisySolutionsAreStationaryPointsOfTheWeightedEquations) {
  SceneGenerator scene(6);
  int judged = 0, lower = 0;
  for (int i = 0; i < 200; ++i) {
    const RelativePose T = scene.general_motion();
    auto acs = scattered(scene, T, 2);
    for (auto& ac : acs) ac = scene.with_noise(ac, 1e-4, 2e-3);
    const auto cost = [&acs](const RelativePose& pose) {
      const Eigen::Matrix3d E = essential_matrix(pose);
      double sum = 0.0;
      for (const auto& ac : acs) {
        sum += std::pow(ac.x2.homogeneous().dot(E * ac.x1.homogeneous()), 2) +
               (kPatchRadius * affine_epipolar_residual(E, ac)).squaredNorm();
      }
      return sum;
    };
    for (const RelativePose& pose : relpose_2ac(acs)) {
      ++judged;
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Matrix3d Q = rotation_from_vector(1e-3 * Eigen::Vector3d::Unit(axis));
        lower += cost({Q * pose.R, pose.t}) < cost(pose) * (1.0 - 1e-9) ? 1 : 0;
        lower += cost({pose.R, Q * pose.t}) < cost(pose) * (1.0 - 1e-9) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(judged, 100);
  EXPECT_LE(lower, judged / 10);  // of six each: narrow valleys that twelve steps do not end
}

TEST(Relpose2ac, ManyCorrespondencesRecoverTheMotionAndUseWeights) {
  SceneGenerator scene(7);
  for (int i = 0; i < 100; ++i) {
    const RelativePose T = scene.general_motion();
    auto acs = scattered(scene, T, 3 + i % 5);
    std::vector<double> weights(acs.size(), 1.0);
    acs.push_back(scene.with_noise(acs[0], 0.1, 0.3));
    weights.push_back(0.0);
    EXPECT_LT(nearest(relpose_nac(acs, weights.data()), T), 1e-6) << "scene " << i << " of seed 7";
  }
}

TEST(Relpose2ac, FaultsAndPureRotationsGiveNothing) {
  SceneGenerator scene(8);
  const RelativePose T = scene.general_motion();
  const auto good = scattered(scene, T, 2);
  for (const Fault& fault : faults(good[0])) {
    if (fault.name == "no motion") continue;  // one standing point beside one that moves
    const std::vector<AffineCorrespondence> acs{fault.ac, good[1]};
    EXPECT_TRUE(relpose_2ac(acs).empty()) << fault.name;
    const std::vector<AffineCorrespondence> other{good[1], fault.ac};
    EXPECT_TRUE(relpose_2ac(other).empty()) << fault.name;
  }
  for (int i = 0; i < 500; ++i) {
    EXPECT_TRUE(relpose_2ac(turned(scene, 2)).empty()) << "case " << i << " of seed 8";
  }
  const std::vector<AffineCorrespondence> same(2, good[0]);
  EXPECT_TRUE(relpose_2ac(same).empty()) << "coincident";
  EXPECT_TRUE(relpose_2ac(AcSpan(good.data(), 1)).empty()) << "one few";
  EXPECT_TRUE(relpose_nac(AcSpan()).empty());
}

TEST(Relpose2ac, DoesNotAllocate) {
  SceneGenerator scene(9);
  const RelativePose T = scene.general_motion();
  const auto acs = scattered(scene, T, 4);
  const std::size_t before = allocation_count();
  const auto two = relpose_2ac(acs);
  const auto many = relpose_nac(acs);
  EXPECT_EQ(allocation_count(), before);
  EXPECT_FALSE(two.empty() || many.empty());
}

}  // namespace
}  // namespace oneac
