#include "solver_test_tools.h"

#include "oneac/solvers/relpose_1ac_front_wall.h"
#include "oneac/solvers/relpose_1ac_side_wall.h"
#include "oneac/test_support/allocation_counter.h"

#include <gtest/gtest.h>

#include <vector>

namespace oneac {
namespace {

using namespace test;

using Matrix64 = Eigen::Matrix<double, 6, 4>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// A_v1 of eq. (10) as printed.
Matrix64 printed_side(const AffineCorrespondence& ac) {
  const double x = ac.x1.x(), u = ac.x2.x(), v = ac.x2.y();
  const double a1 = ac.A(0, 0), a2 = ac.A(0, 1), a3 = ac.A(1, 0), a4 = ac.A(1, 1);
  Matrix64 A;
  A << x - u, -1 - u * x, -x, u * x, -v, -v * x, 0, v * x, 1 - a1, -a1 * x - u, -1, a1 * x + u, -a2,
      -a2 * x, 0, a2 * x, -a3, -a3 * x - v, 0, a3 * x + v, -a4, -a4 * x, 0, a4 * x;
  return A;
}

/// A_v2 of eq. (10) as printed.
Matrix64 printed_front(const AffineCorrespondence& ac) {
  const double x = ac.x1.x(), u = ac.x2.x(), v = ac.x2.y();
  const double a1 = ac.A(0, 0), a2 = ac.A(0, 1), a3 = ac.A(1, 0), a4 = ac.A(1, 1);
  Matrix64 A;
  A << x - u, -1 - u * x, -1, u, -v, -v * x, 0, v, 1 - a1, -a1 * x - u, 0, a1, -a2, -a2 * x, 0, a2,
      -a3, -a3 * x - v, 0, a3, -a4, -a4 * x, 0, a4;
  return A;
}

Plane side_wall(SceneGenerator& scene) {
  const double side = scene.uniform(-1, 1) > 0.0 ? 1.0 : -1.0;
  return {side * Eigen::Vector3d::UnitX(), scene.uniform(2.0, 6.0)};
}

Plane front_wall(SceneGenerator& scene) {
  return {Eigen::Vector3d::UnitZ(), scene.uniform(4, 20)};
}

struct Form {
  const char* name;
  Plane (*plane)(SceneGenerator&);
  Matrix64 (*printed)(const AffineCorrespondence&);
  SolutionSet<WallPose, 1> (*single)(const AffineCorrespondence&);
  SolutionSet<WallPose, 1> (*multi)(AcSpan, const double*);
};

struct Case {
  RelativePose T;
  Plane plane;
  AffineCorrespondence ac;
};

/// Away from the vanishing lines, where the solvers are defined.
AffineCorrespondence on_wall(SceneGenerator& scene, const RelativePose& T, const Plane& plane) {
  for (;;) {
    AffineCorrespondence ac = scene.on_plane(T, plane);
    if (ac.x1.cwiseAbs().minCoeff() > 0.02) return ac;
  }
}

Case wall_case(SceneGenerator& scene, const Form& form) {
  Case c{scene.planar_motion(), form.plane(scene), {}};
  c.ac = on_wall(scene, c.T, c.plane);
  return c;
}

double cost(const WallPose& pose, const AffineCorrespondence& ac) {
  const Plane plane{pose.normal(), 1.0};
  return homography_residual(plane_induced_homography(pose.pose(), plane), ac).squaredNorm();
}

class SpecialWall : public testing::TestWithParam<Form> {};

TEST_P(SpecialWall, TruthSatisfiesThePrintedEquationsWithTheOppositeSign) {
  SceneGenerator scene(1);
  for (int i = 0; i < 1000; ++i) {
    const Case c = wall_case(scene, GetParam());
    const double d =
        c.plane.n.sum() * c.plane.d;  // for n = (1, 0, 0) or (0, 0, 1), sign of the side
    const Eigen::Vector4d x(cos_of(c.T), sin_of(c.T), -c.T.t.x() / d, -c.T.t.z() / d);
    Vector6 b;
    b << 0, -c.ac.x1.y(), 0, 0, 0, -1;
    EXPECT_LT((GetParam().printed(c.ac) * x - b).norm(), 1e-11) << "scene " << i << " of seed 1";
  }
}

TEST_P(SpecialWall, RecoversMotionAndSideOfThousandScenes) {
  SceneGenerator scene(2);
  for (int i = 0; i < 1000; ++i) {
    const Case c = wall_case(scene, GetParam());
    const auto found = GetParam().single(c.ac);
    ASSERT_EQ(found.size(), 1u) << "scene " << i << " of seed 2";
    EXPECT_LT(pose_error(found[0].pose(), c.T), kExact) << "scene " << i << " of seed 2";
    EXPECT_LT((found[0].pose().t * c.plane.d - c.T.t).norm(), kExact);
    EXPECT_LT((found[0].normal() - c.plane.n).norm(), 1e-15);
    EXPECT_LT(cost(found[0], c.ac), 1e-16);
  }
}

TEST_P(SpecialWall, RecoversFromManyCorrespondences) {
  SceneGenerator scene(3);
  for (int i = 0; i < 200; ++i) {
    const RelativePose T = scene.planar_motion();
    const Plane plane = GetParam().plane(scene);
    const int count = 2 + i % 9;
    std::vector<AffineCorrespondence> acs;
    acs.reserve(static_cast<std::size_t>(count) + 1);
    for (int k = 0; k < count; ++k) acs.push_back(on_wall(scene, T, plane));
    std::vector<double> weights(acs.size(), 1.0);
    acs[0] = scene.with_noise(acs[0], 0.1, 0.3);
    weights[0] = 0.0;
    acs.push_back(acs[1]);
    acs.back().A(1, 1) = std::nan("");
    weights.push_back(1.0);
    const auto found = GetParam().multi(acs, weights.data());
    ASSERT_EQ(found.size(), 1u) << "scene " << i << " of seed 3";
    EXPECT_LT(pose_error(found[0].pose(), T), kExact) << "scene " << i << " of seed 3";
  }
}

TEST_P(SpecialWall, ScaleOfTheSceneDoesNotMatter) {
  SceneGenerator scene(4);
  const Case c = wall_case(scene, GetParam());
  const auto H = plane_induced_homography({c.T.R, 50.0 * c.T.t}, {c.plane.n, 50.0 * c.plane.d});
  const auto large = GetParam().single(*correspondence_from_homography(H, c.ac.x1));
  const auto small = GetParam().single(c.ac);
  ASSERT_EQ(small.size() + large.size(), 2u);
  EXPECT_LT((small[0].pose().t - large[0].pose().t).norm(), 1e-11);
}

TEST_P(SpecialWall, FaultsGiveNothing) {
  SceneGenerator scene(5);
  const Case c = wall_case(scene, GetParam());
  for (const Fault& fault : faults(c.ac)) {
    EXPECT_TRUE(GetParam().single(fault.ac).empty()) << fault.name;
  }
  for (int i = 0; i < 1000; ++i) {
    const auto turned = pure_rotation(scene.uniform(-0.5, 0.5), scene.image_point());
    EXPECT_TRUE(GetParam().single(turned).empty()) << "case " << i << " of seed 5";
  }
  EXPECT_TRUE(GetParam().single(on_horizon(c.T, c.plane, c.ac.x1.x())).empty());
  EXPECT_TRUE(GetParam().multi(AcSpan(), nullptr).empty());
}

TEST_P(SpecialWall, WallBehindTheSecondCameraGivesNothing) {
  SceneGenerator scene(6);
  const Case c = wall_case(scene, GetParam());
  const Eigen::Matrix3d H = plane_induced_homography(c.T, c.plane);
  AffineCorrespondence ac = c.ac;  // through H with the third coordinate negative
  const RelativePose through{Eigen::Matrix3d::Identity(), {0.0, 0.0, -30.0}};
  const Eigen::Vector3d y = plane_induced_homography(through, c.plane) * ac.x1.homogeneous();
  if (y.z() > 0.0) return;  // the side wall stays in front for this point
  const Eigen::Matrix3d G = plane_induced_homography(through, c.plane);
  ac.x2 = y.head<2>() / y.z();
  ac.A = (G.topLeftCorner<2, 2>() - ac.x2 * G.block<1, 2>(2, 0)) / y.z();
  EXPECT_TRUE(GetParam().single(ac).empty());
  EXPECT_FALSE(GetParam().single(*correspondence_from_homography(H, c.ac.x1)).empty());
}

TEST_P(SpecialWall, DoesNotAllocate) {
  SceneGenerator scene(7);
  const Case c = wall_case(scene, GetParam());
  const std::size_t before = allocation_count();
  const auto found = GetParam().single(c.ac);
  const auto again = GetParam().multi(AcSpan(&c.ac, 1), nullptr);
  EXPECT_EQ(allocation_count(), before);
  EXPECT_EQ(found.size() + again.size(), 2u);
}

INSTANTIATE_TEST_SUITE_P(
    Forms, SpecialWall,
    testing::Values(Form{"SideOptimal", &side_wall, &printed_side, &relpose_1ac_side_wall,
                         &relpose_nac_side_wall},
                    Form{"SideRapid", &side_wall, &printed_side, &relpose_1ac_side_wall_rapid,
                         &relpose_nac_side_wall_rapid},
                    Form{"FrontOptimal", &front_wall, &printed_front, &relpose_1ac_front_wall,
                         &relpose_nac_front_wall},
                    Form{"FrontRapid", &front_wall, &printed_front, &relpose_1ac_front_wall_rapid,
                         &relpose_nac_front_wall_rapid}),
    [](const auto& form) { return std::string(form.param.name); });

TEST(SpecialWallOptimal, NeverCostsMoreThanTheRapidSolver) {
  SceneGenerator scene(8);
  const auto check = [&scene](const Form& form, auto optimal, auto rapid) {
    for (int i = 0; i < 20000; ++i) {
      const auto noisy = scene.with_noise(wall_case(scene, form).ac, 0.005, 0.05);
      const auto best = optimal(noisy);
      const auto fast = rapid(noisy);
      if (best.empty() || fast.empty()) continue;
      ASSERT_LE(cost(best[0], noisy), cost(fast[0], noisy) * (1.0 + 1e-9) + 1e-15) << i;
    }
  };
  check({"", &side_wall, nullptr, nullptr, nullptr}, &relpose_1ac_side_wall,
        &relpose_1ac_side_wall_rapid);
  check({"", &front_wall, nullptr, nullptr, nullptr}, &relpose_1ac_front_wall,
        &relpose_1ac_front_wall_rapid);
}

}  // namespace
}  // namespace oneac
