#include "oneac/solvers/relpose_1ac_wall.h"

#include "solver_test_tools.h"

#include "oneac/test_support/allocation_counter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace oneac {
namespace {

using namespace test;

struct Case {
  RelativePose T;
  Plane plane;
  AffineCorrespondence ac;
};

AffineCorrespondence on_wall(SceneGenerator& scene, const RelativePose& T, const Plane& plane) {
  for (;;) {
    AffineCorrespondence ac = scene.on_plane(T, plane);
    if (std::abs(ac.x1.y()) > 0.02 && std::abs(ac.x2.y()) > 0.02) return ac;
  }
}

Case wall_case(SceneGenerator& scene) {
  const double delta = scene.uniform(0.5, 2.6);
  Case c{
      scene.planar_motion(), {{std::cos(delta), 0.0, std::sin(delta)}, scene.uniform(3, 15)}, {}};
  c.ac = on_wall(scene, c.T, c.plane);
  return c;
}

template <class Poses>
double nearest(const Poses& poses, const RelativePose& T) {
  double least = 10.0;
  for (const WallPose& pose : poses) least = std::min(least, pose_error(pose.pose(), T));
  return least;
}

Eigen::Matrix3d homography(const WallPose& pose) {
  return plane_induced_homography(pose.pose(), {pose.normal(), 1.0});
}

TEST(Relpose1acWall, TruthSatisfiesThePrintedSystemAndTheCorrectedEquations) {
  SceneGenerator scene(1);
  for (int i = 0; i < 1000; ++i) {
    const Case c = wall_case(scene);
    const Eigen::Matrix3d H = plane_induced_homography(c.T, c.plane);
    const double x = c.ac.x1.x(), y = c.ac.x1.y(), u = c.ac.x2.x(), v = c.ac.x2.y();
    const double a1 = c.ac.A(0, 0), a2 = c.ac.A(0, 1), a3 = c.ac.A(1, 0), a4 = c.ac.A(1, 1);
    Eigen::Matrix<double, 6, 5> A;  // A_vert as printed
    A << 1, 0, 0, -(u + a1 * x), -a1, 0, 0, 0, -a2 * x, -a2, 0, 0, 0, -(v + a3 * x), -a3, 0, 0, 1,
        -a4 * x, -a4, x, 1, 0, -x * u, -u, 0, 0, y, -x * v, -v;
    Eigen::Matrix<double, 5, 1> h;
    h << H(0, 0), H(0, 2), H(1, 1), H(2, 0), H(2, 2);
    EXPECT_LT((A * h).norm(), 1e-12);
    EXPECT_EQ(H(1, 1), 1.0);
    // Erratum of eq. (11): with the rotation of eq. (2) the signs of sin α are these, and it is cos
    // δ.
    const double cd = c.plane.n.x(), sd = c.plane.n.z(), ca = cos_of(c.T), sa = sin_of(c.T);
    EXPECT_NEAR(H(0, 0) * sd - H(0, 2) * cd, sa * cd + ca * sd, 1e-12);  // sin(α + δ)
    EXPECT_NEAR(H(2, 2) * cd - H(2, 0) * sd, ca * cd - sa * sd, 1e-12);  // cos(α + δ)
    // Erratum: the singular values of B themselves enclose one, not their squares' roots.
    Eigen::Matrix2d B;
    B << H(2, 2), -H(2, 0), -H(0, 2), H(0, 0);
    EXPECT_NEAR((B * Eigen::Vector2d(cd, sd)).norm(), 1.0, 1e-12);
    const Eigen::Vector2d sigma = B.jacobiSvd().singularValues();
    EXPECT_GE(sigma(0), 1.0 - 1e-12);
    EXPECT_LE(sigma(1), 1.0 + 1e-12);
  }
}

TEST(Relpose1acWall, TruthIsAmongTheCandidatesOfThousandScenes) {
  SceneGenerator scene(2);
  for (int i = 0; i < 1000; ++i) {
    const Case c = wall_case(scene);
    const auto found = relpose_1ac_wall(c.ac);
    ASSERT_FALSE(found.empty()) << "scene " << i << " of seed 2";
    const auto best = *std::min_element(found.begin(), found.end(), [&c](auto& a, auto& b) {
      return pose_error(a.pose(), c.T) < pose_error(b.pose(), c.T);
    });
    EXPECT_LT(pose_error(best.pose(), c.T), kExact) << "scene " << i << " of seed 2";
    EXPECT_LT(direction_error(best.normal(), c.plane.n), kExact) << "scene " << i << " of seed 2";
    EXPECT_NEAR(best.pose().t.norm() * c.plane.d, c.T.t.norm(), kExact * c.plane.d);
  }
}

TEST(Relpose1acWall, EveryCandidateReproducesTheHomographyInFrontOfBothCameras) {
  SceneGenerator scene(3);
  for (int i = 0; i < 1000; ++i) {
    const Case c = wall_case(scene);
    for (const WallPose& pose : relpose_1ac_wall(c.ac)) {
      EXPECT_NEAR(std::hypot(pose.cos_alpha, pose.sin_alpha), 1.0, 1e-14);
      EXPECT_NEAR(pose.normal().norm(), 1.0, 1e-14);
      EXPECT_LT((homography(pose) - plane_induced_homography(c.T, c.plane)).norm(), kExact);
      const double depth = 1.0 / pose.normal().dot(c.ac.x1.homogeneous());
      EXPECT_GT(depth, 0.0);
      EXPECT_GT((pose.pose() * (depth * c.ac.x1.homogeneous())).z(), 0.0);
    }
  }
}

TEST(Relpose1acWall, CandidatesAreThePosesAndTheirTwins) {
  SceneGenerator scene(4);
  const Case c = wall_case(scene);
  const auto selected = relpose_1ac_wall(c.ac);
  const auto all = relpose_1ac_wall_candidates(c.ac);
  ASSERT_EQ(selected.size(), 2u);
  ASSERT_EQ(all.size(), 4u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT((homography(all[2 * i]) - homography(all[2 * i + 1])).norm(), 1e-15);
    EXPECT_LT((all[2 * i].pose().t + all[2 * i + 1].pose().t).norm(), 1e-15);
    EXPECT_LT((all[2 * i].normal() - selected[i].normal()).norm(), 1e-15);
  }
  EXPECT_GT(rotation_error(selected[0].pose().R, selected[1].pose().R), 1e-6);
}

TEST(Relpose1acWall, ClampsToTheNearestPointWhenNoiseSeparatesCircleAndEllipse) {
  SceneGenerator scene(5);
  int clamped = 0;
  for (int i = 0; i < 2000; ++i) {
    const RelativePose T{Eigen::Matrix3d::Identity(), {0.0, 0.0, -1.0}};
    const AffineCorrespondence noisy =
        scene.with_noise(on_wall(scene, T, {Eigen::Vector3d::UnitZ(), 8.0}), 1e-3, 1e-3);
    const auto found = relpose_1ac_wall(noisy);
    ASSERT_FALSE(found.empty()) << "case " << i << " of seed 5";
    clamped += found.size() == 1 ? 1 : 0;
    EXPECT_TRUE(found[0].pose().is_finite());
  }
  EXPECT_GT(clamped, 100);
}

TEST(Relpose1acWall, ManyCorrespondencesAgreeWithOneAndUseWeights) {
  SceneGenerator scene(6);
  for (int i = 0; i < 200; ++i) {
    const Case c = wall_case(scene);
    std::vector<AffineCorrespondence> acs{c.ac};
    EXPECT_NEAR(nearest(relpose_nac_wall(acs), c.T), 0.0, kExact);
    for (int k = 0; k < 1 + i % 8; ++k) acs.push_back(on_wall(scene, c.T, c.plane));
    std::vector<double> weights(acs.size(), 2.0);
    acs.push_back(scene.with_noise(acs.back(), 0.002, 0.1));
    weights.push_back(0.0);
    EXPECT_LT(nearest(relpose_nac_wall(acs, weights.data()), c.T), kExact) << "scene " << i;
    EXPECT_GT(nearest(relpose_nac_wall(acs), c.T), 1e-6);
  }
}

TEST(Relpose1acWall, ClosedFormOfOneIsTheLeastSquaresOfMany) {
  SceneGenerator scene(7);
  for (int i = 0; i < 500; ++i) {
    const AffineCorrespondence noisy = scene.with_noise(wall_case(scene).ac, 0.002, 0.02);
    const auto one = relpose_1ac_wall(noisy);
    const auto many = relpose_nac_wall(AcSpan(&noisy, 1));
    ASSERT_EQ(one.size(), many.size());
    for (std::size_t k = 0; k < one.size(); ++k) {
      EXPECT_LT((homography(one[k]) - homography(many[k])).norm(), kExact) << "case " << i;
    }
  }
}

TEST(Relpose1acWall, FaultsGiveNothing) {
  SceneGenerator scene(8);
  const Case c = wall_case(scene);
  for (const Fault& fault : faults(c.ac)) {
    EXPECT_TRUE(relpose_1ac_wall(fault.ac).empty()) << fault.name;
    EXPECT_TRUE(relpose_1ac_wall_candidates(fault.ac).empty()) << fault.name;
    EXPECT_TRUE(relpose_nac_wall(AcSpan(&fault.ac, 1)).empty()) << fault.name;
  }
  for (int i = 0; i < 1000; ++i) {
    const auto turned = pure_rotation(scene.uniform(-0.5, 0.5), scene.image_point());
    EXPECT_TRUE(relpose_1ac_wall(turned).empty()) << "case " << i << " of seed 8";
    EXPECT_TRUE(relpose_nac_wall(AcSpan(&turned, 1)).empty()) << "case " << i << " of seed 8";
  }
  EXPECT_TRUE(relpose_1ac_wall(on_horizon(c.T, c.plane, c.ac.x1.x())).empty());
  EXPECT_TRUE(relpose_nac_wall(AcSpan()).empty());
}

TEST(Relpose1acWall, DoesNotAllocate) {
  SceneGenerator scene(9);
  const Case c = wall_case(scene);
  const std::size_t before = allocation_count();
  const auto found = relpose_1ac_wall(c.ac);
  const auto all = relpose_1ac_wall_candidates(c.ac);
  const auto many = relpose_nac_wall(AcSpan(&c.ac, 1));
  EXPECT_EQ(allocation_count(), before);
  EXPECT_FALSE(found.empty() || all.empty() || many.empty());
}

}  // namespace
}  // namespace oneac
