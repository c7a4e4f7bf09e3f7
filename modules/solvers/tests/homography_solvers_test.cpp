#include "point_solver_tools.h"

#include "oneac/solvers/homography_2ac.h"
#include "oneac/solvers/homography_4pc.h"
#include "oneac/solvers/homography_decomposition.h"
#include "oneac/test_support/allocation_counter.h"

#include <gtest/gtest.h>

namespace oneac {
namespace {

using namespace test;

struct Form {
  const char* name;
  int count;
  SolutionSet<Eigen::Matrix3d, 1> (*solve)(AcSpan, const double*);
};

struct Case {
  RelativePose T;
  Plane plane;
  std::vector<AffineCorrespondence> acs;
};

Case plane_case(SceneGenerator& scene, int count) {
  Case c{scene.general_motion(), scene.any_plane(), {}};
  c.acs = on_one_plane(scene, c.T, c.plane, count);
  return c;
}

class HomographySolver : public testing::TestWithParam<Form> {};

TEST_P(HomographySolver, RecoversThousandPlanesWithScaleAndSign) {
  SceneGenerator scene(1);
  for (int i = 0; i < 1000; ++i) {
    const Case c = plane_case(scene, GetParam().count + i % 4);
    const auto found = GetParam().solve(c.acs, nullptr);
    ASSERT_EQ(found.size(), 1u) << "scene " << i << " of seed 1";
    const Eigen::Matrix3d truth = plane_induced_homography(c.T, c.plane);
    const double error = (found[0] - truth).norm();  // its middle singular value is one already
    EXPECT_LT(error, kExact) << "scene " << i << " of seed 1";
  }
}

TEST_P(HomographySolver, DecompositionHoldsTheMotionAndTheNormal) {
  SceneGenerator scene(2);
  for (int i = 0; i < 1000; ++i) {
    const Case c = plane_case(scene, GetParam().count + i % 4);
    const auto poses = poses_from_homography(GetParam().solve(c.acs, nullptr)[0], c.acs);
    ASSERT_FALSE(poses.empty()) << "scene " << i << " of seed 2";
    double least = 10.0;
    for (const PlanePose& pose : poses) {
      const double error = pose_error(pose.pose(), c.T) + direction_error(pose.n, c.plane.n) +
                           (pose.motion.t * c.plane.d - c.T.t).norm();
      least = std::min(least, error);
    }
    EXPECT_LT(least, kExact) << "scene " << i << " of seed 2";
  }
}

TEST_P(HomographySolver, WeightZeroRemovesAnOutlier) {
  SceneGenerator scene(3);
  Case c = plane_case(scene, GetParam().count + 3);
  std::vector<double> weights(c.acs.size(), 0.7);
  c.acs[1].x2.x() += 0.3;
  weights[1] = 0.0;
  const auto found = GetParam().solve(c.acs, weights.data());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_LT((found[0] - plane_induced_homography(c.T, c.plane)).norm(), kExact);
}

TEST_P(HomographySolver, BrokenInputGivesNothing) {
  SceneGenerator scene(4);
  const Case c = plane_case(scene, GetParam().count);
  const auto solve = [](AcSpan acs) {  // no motion is a homography (the identity) but no pose
    const auto H = GetParam().solve(acs, nullptr);
    return H.empty() ? SolutionSet<PlanePose, 2>() : poses_from_homography(H[0], acs);
  };
  auto still = c.acs;
  for (auto& ac : still) ac.A.setIdentity();
  expect_nothing_from_broken_points(still, solve);
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(solve(turned(scene, GetParam().count)).empty()) << i;
  auto mirrored = c.acs;
  for (auto& ac : mirrored) ac.x2.x() = -ac.x2.x(), ac.A.row(0) = -ac.A.row(0);
  EXPECT_TRUE(solve(mirrored).empty());
}

TEST_P(HomographySolver, DoesNotAllocate) {
  SceneGenerator scene(5);
  const Case c = plane_case(scene, GetParam().count);
  const std::size_t before = allocation_count();
  const auto H = GetParam().solve(c.acs, nullptr);
  const auto poses = poses_from_homography(H[0], c.acs);
  EXPECT_EQ(allocation_count(), before);
  EXPECT_FALSE(poses.empty());
}

INSTANTIATE_TEST_SUITE_P(Forms, HomographySolver,
                         testing::Values(Form{"FourPoints", 4, &homography_4pc},
                                         Form{"TwoAffine", 2, &homography_2ac}),
                         [](const auto& form) { return std::string(form.param.name); });

TEST(DecomposeHomography, EveryCandidateReproducesIt) {
  SceneGenerator scene(6);
  for (int i = 0; i < 1000; ++i) {
    const RelativePose T = scene.general_motion();
    const Eigen::Matrix3d H = plane_induced_homography(T, scene.any_plane());
    const auto poses = decompose_homography(-3.0 * -H);
    ASSERT_EQ(poses.size(), 4u);
    for (const PlanePose& pose : poses) {
      EXPECT_LT((pose.motion.R + pose.motion.t * pose.n.transpose() - H).norm(), 1e-9) << i;
      EXPECT_LT((pose.motion.R * pose.motion.R.transpose() - Eigen::Matrix3d::Identity()).norm(),
                1e-7);
      EXPECT_NEAR(pose.motion.R.determinant(), 1.0, 1e-7);
    }
  }
}

// The rotation is a difference of numbers as large as t: beyond some length it would be none.
TEST(DecomposeHomography, NoLengthGivesAMatrixThatIsNoRotation) {
  const Eigen::Vector3d n = Eigen::Vector3d(0.3, 0.8, 0.52).normalized();
  const Eigen::Matrix3d R = yaw_rotation(std::cos(0.2), std::sin(0.2));
  for (const double length : {1e2, 1e3, 1e5, 1e6, 1e7, 1e8, 1e10}) {
    const Eigen::Vector3d t = length * Eigen::Vector3d(0.2, 0.5, 0.7);
    const auto poses = decompose_homography(R + t * n.transpose());
    EXPECT_EQ(poses.empty(), length > 1e4) << length;
    for (const PlanePose& pose : poses) {
      const Eigen::Matrix3d I = pose.motion.R.transpose() * pose.motion.R;
      EXPECT_TRUE(I.isIdentity(1e-6)) << length;
    }
  }
}

TEST(DecomposeHomography, RotationsZeroAndNaNGiveNothing) {
  EXPECT_TRUE(decompose_homography(yaw_rotation(std::cos(0.2), std::sin(0.2))).empty());
  EXPECT_TRUE(decompose_homography(Eigen::Matrix3d::Zero()).empty());
  EXPECT_TRUE(decompose_homography(Eigen::Matrix3d::Constant(std::nan(""))).empty());
  EXPECT_TRUE(decompose_homography(Eigen::Vector3d(1, 1, 0).asDiagonal().toDenseMatrix()).empty());
}

}  // namespace
}  // namespace oneac
