#include "oneac/solvers/relpose_1ac_ground.h"

#include "solver_test_tools.h"

#include "oneac/test_support/allocation_counter.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <vector>

namespace oneac {
namespace {

using namespace test;

struct GroundCase {
  RelativePose T;
  Plane plane;
  AffineCorrespondence ac;
};

GroundCase ground_case(SceneGenerator& scene) {
  GroundCase c{scene.planar_motion(), scene.ground(), {}};
  c.ac = scene.on_plane(c.T, c.plane);
  return c;
}

std::vector<AffineCorrespondence> ground_correspondences(SceneGenerator& scene,
                                                         const RelativePose& T, const Plane& plane,
                                                         int count) {
  std::vector<AffineCorrespondence> acs;
  acs.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) acs.push_back(scene.on_plane(T, plane));
  return acs;
}

/// |A_gd x − b|² of a pose, through the homography equations (4), (5) rather than the solver's
/// rows.
double cost(const PlanarPose& pose, const AffineCorrespondence& ac) {
  const Plane unit_ground{Eigen::Vector3d::UnitY(), 1.0};
  return homography_residual(plane_induced_homography(pose.pose(), unit_ground), ac).squaredNorm();
}

/// A_gd and b as the paper prints them, eq. (9).
struct PrintedSystem {
  Eigen::Matrix<double, 6, 4> A;
  Eigen::Matrix<double, 6, 1> b;
};

PrintedSystem printed_system(const AffineCorrespondence& ac) {
  const double x = ac.x1.x(), y = ac.x1.y(), u = ac.x2.x(), v = ac.x2.y();
  const double a1 = ac.A(0, 0), a2 = ac.A(0, 1), a3 = ac.A(1, 0), a4 = ac.A(1, 1);
  PrintedSystem system;
  system.A << x - u, -u * x - 1, y, -u * y, -v, -v * x, 0, -v * y, 1 - a1, -u - a1 * x, 0, -a1 * y,
      -a2, -a2 * x, 1, -u - a2 * y, -a3, -v - a3 * x, 0, -a3 * y, -a4, -a4 * x, 0, -v - a4 * y;
  system.b << 0, -y, 0, 0, 0, -1;
  return system;
}

using Solver = SolutionSet<PlanarPose, 1> (*)(const AffineCorrespondence&);
using MultiSolver = SolutionSet<PlanarPose, 1> (*)(AcSpan, const double*);

struct Forms {
  const char* name;
  Solver single;
  MultiSolver multi;
};

class Relpose1acGround : public testing::TestWithParam<Forms> {};

TEST_P(Relpose1acGround, TruthSatisfiesThePrintedEquations) {
  SceneGenerator scene(1);
  for (int i = 0; i < 1000; ++i) {
    const GroundCase c = ground_case(scene);
    const PrintedSystem system = printed_system(c.ac);
    // Erratum on signs: p = t_x/d and q = t_z/d directly, for n·X = d > 0.
    const Eigen::Vector4d x(cos_of(c.T), sin_of(c.T), c.T.t.x() / c.plane.d, c.T.t.z() / c.plane.d);
    EXPECT_LT((system.A * x - system.b).norm(), 1e-11) << "scene " << i << " of seed 1";
  }
}

TEST_P(Relpose1acGround, RecoversMetricMotionOfThousandScenes) {
  SceneGenerator scene(2);
  for (int i = 0; i < 1000; ++i) {
    const GroundCase c = ground_case(scene);
    const auto found = GetParam().single(c.ac);
    ASSERT_EQ(found.size(), 1u) << "scene " << i << " of seed 2";
    const RelativePose truth = in_units(c.T, c.plane.d);
    EXPECT_LT(pose_error(found[0].pose(), truth), kExact) << "scene " << i << " of seed 2";
    EXPECT_LT((found[0].pose().t - truth.t).norm(), kExact) << "scene " << i << " of seed 2";
  }
}

TEST_P(Relpose1acGround, RecoversFromManyCorrespondences) {
  SceneGenerator scene(3);
  for (int i = 0; i < 200; ++i) {
    const RelativePose T = scene.planar_motion();
    const Plane plane = scene.ground();
    const auto acs = ground_correspondences(scene, T, plane, 2 + i % 9);
    const auto found = GetParam().multi(acs, nullptr);
    ASSERT_EQ(found.size(), 1u) << "scene " << i << " of seed 3";
    EXPECT_LT(pose_error(found[0].pose(), T), kExact) << "scene " << i << " of seed 3";
    EXPECT_LT((found[0].pose().t * plane.d - T.t).norm(), kExact);
  }
}

TEST_P(Relpose1acGround, CandidateIsAUnitRotationThatSatisfiesTheEquations) {
  SceneGenerator scene(4);
  for (int i = 0; i < 1000; ++i) {
    const GroundCase c = ground_case(scene);
    const auto found = GetParam().single(c.ac);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(std::hypot(found[0].cos_alpha, found[0].sin_alpha), 1.0, 1e-14);
    EXPECT_LT(cost(found[0], c.ac), 1e-16);
  }
}

TEST_P(Relpose1acGround, DivisionByTheLastEntryDoesNotNormalise) {
  // Erratum: on noisy data the null vector divided by its last entry has x1² + x2² ≠ 1; the solvers
  // must return a rotation all the same.
  SceneGenerator scene(5);
  const AffineCorrespondence noisy = scene.with_noise(ground_case(scene).ac, 0.01, 0.05);
  const PrintedSystem system = printed_system(noisy);
  Eigen::Matrix<double, 6, 5> homogeneous;
  homogeneous << system.A, -system.b;
  const Eigen::JacobiSVD<Eigen::Matrix<double, 6, 5>> svd(homogeneous, Eigen::ComputeFullV);
  const Eigen::Matrix<double, 5, 1> x = svd.matrixV().col(4) / svd.matrixV()(4, 4);
  EXPECT_GT(std::abs(std::hypot(x(0), x(1)) - 1.0), 1e-4);
  const auto found = GetParam().single(noisy);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(std::hypot(found[0].cos_alpha, found[0].sin_alpha), 1.0, 1e-14);
}

TEST_P(Relpose1acGround, SignOfTranslationIsThatOfTheMotion) {
  // Erratum: the paper's p = −ρ cos β would turn the car around.
  const Plane plane{Eigen::Vector3d::UnitY(), 1.5};
  const RelativePose forward{Eigen::Matrix3d::Identity(), {0.0, 0.0, -1.0}};
  const AffineCorrespondence ac =
      *correspondence_from_homography(plane_induced_homography(forward, plane), {0.1, 0.3});
  const auto found = GetParam().single(ac);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].tz, -1.0 / 1.5, 1e-10);  // points come closer when the car drives forward
  EXPECT_NEAR(found[0].tx, 0.0, 1e-10);
}

TEST_P(Relpose1acGround, SwappedViewsGiveTheInverseMotion) {
  SceneGenerator scene(6);
  for (int i = 0; i < 200; ++i) {
    const GroundCase c = ground_case(scene);
    const auto found = GetParam().single(swapped(c.ac));
    ASSERT_EQ(found.size(), 1u);
    const RelativePose truth = in_units(c.T.inverse(), c.plane.d);
    EXPECT_LT(pose_error(found[0].pose(), truth), kExact);
    EXPECT_LT((found[0].pose().t - truth.t).norm(), kExact);
  }
}

TEST_P(Relpose1acGround, ScaleOfTheSceneDoesNotMatter) {
  SceneGenerator scene(7);
  const RelativePose T = scene.planar_motion();
  const Plane plane = scene.ground();
  const RelativePose T_large{T.R, 100.0 * T.t};
  const Plane plane_large{plane.n, 100.0 * plane.d};
  const auto small = GetParam().single(
      *correspondence_from_homography(plane_induced_homography(T, plane), {0.2, 0.4}));
  const auto large = GetParam().single(
      *correspondence_from_homography(plane_induced_homography(T_large, plane_large), {0.2, 0.4}));
  ASSERT_EQ(small.size() + large.size(), 2u);
  EXPECT_LT((small[0].pose().t - large[0].pose().t).norm(), 1e-12);
}

TEST_P(Relpose1acGround, FaultyCorrespondencesGiveNothing) {
  SceneGenerator scene(8);
  const GroundCase c = ground_case(scene);
  for (const Fault& fault : faults(c.ac)) {
    EXPECT_TRUE(GetParam().single(fault.ac).empty()) << fault.name;
  }
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector2d x1 = scene.image_point(kHorizon, 0.5);
    EXPECT_TRUE(GetParam().single(pure_rotation(scene.uniform(-0.5, 0.5), x1)).empty());
  }
  EXPECT_TRUE(GetParam().single(on_horizon(c.T, c.plane, 0.1)).empty());
  AffineCorrespondence sky = c.ac;
  sky.x1.y() = -sky.x1.y();
  EXPECT_TRUE(GetParam().single(sky).empty());
  EXPECT_TRUE(GetParam().multi(AcSpan(), nullptr).empty());
}

TEST_P(Relpose1acGround, NeverReturnsNaNOnExtremeNumbers) {
  SceneGenerator scene(9);
  for (int i = 0; i < 20000; ++i) {
    const AffineCorrespondence ac = extreme_correspondence(scene);
    for (const PlanarPose& pose : GetParam().single(ac)) {
      EXPECT_TRUE(pose.pose().is_finite()) << "case " << i << " of seed 9";
    }
  }
}

TEST_P(Relpose1acGround, WeightZeroRemovesAnOutlierAndFaultsAreLeftOut) {
  SceneGenerator scene(10);
  const RelativePose T = scene.planar_motion();
  const Plane plane = scene.ground();
  auto acs = ground_correspondences(scene, T, plane, 5);
  acs[2] = scene.with_noise(acs[2], 0.1, 0.3);
  acs[3].A(0, 0) = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> weights{1.0, 2.0, 0.0, 1.0, 0.5};
  const auto found = GetParam().multi(acs, weights.data());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_LT(pose_error(found[0].pose(), T), kExact);
}

TEST_P(Relpose1acGround, IntegerWeightEqualsRepetition) {
  SceneGenerator scene(11);
  const RelativePose T = scene.planar_motion();
  const Plane plane = scene.ground();
  auto acs = ground_correspondences(scene, T, plane, 3);
  for (auto& ac : acs) ac = scene.with_noise(ac, 0.002, 0.02);
  const std::vector<double> weights{1.0, 3.0, 1.0};
  const std::vector<AffineCorrespondence> repeated{acs[0], acs[1], acs[1], acs[1], acs[2]};
  const auto weighted = GetParam().multi(acs, weights.data());
  const auto plain = GetParam().multi(repeated, nullptr);
  ASSERT_EQ(weighted.size() + plain.size(), 2u);
  EXPECT_LT((weighted[0].pose().t - plain[0].pose().t).norm(), 1e-10);
  EXPECT_LT(rotation_error(weighted[0].pose().R, plain[0].pose().R), 1e-10);
  EXPECT_GT(rotation_error(weighted[0].pose().R, GetParam().multi(acs, nullptr)[0].pose().R), 1e-9);
}

TEST_P(Relpose1acGround, DoesNotAllocate) {
  SceneGenerator scene(12);
  const GroundCase c = ground_case(scene);
  const std::size_t before = allocation_count();
  const auto found = GetParam().single(c.ac);
  const auto again = GetParam().multi(AcSpan(&c.ac, 1), nullptr);
  EXPECT_EQ(allocation_count(), before);
  EXPECT_EQ(found.size() + again.size(), 2u);
}

INSTANTIATE_TEST_SUITE_P(Forms, Relpose1acGround,
                         testing::Values(Forms{"Optimal", &relpose_1ac_ground, &relpose_nac_ground},
                                         Forms{"Rapid", &relpose_1ac_ground_rapid,
                                               &relpose_nac_ground_rapid}),
                         [](const auto& form) { return std::string(form.param.name); });

TEST(Relpose1acGroundRapid, IsTheNullVectorOfTheSingularValueDecomposition) {
  SceneGenerator scene(15);
  int compared = 0;
  for (int i = 0; i < 5000; ++i) {
    const AffineCorrespondence noisy = scene.with_noise(ground_case(scene).ac, 0.002, 0.03);
    const PrintedSystem system = printed_system(noisy);
    Eigen::Matrix<double, 6, 5> homogeneous;
    homogeneous << system.A, -system.b;
    const Eigen::JacobiSVD<Eigen::Matrix<double, 6, 5>> svd(homogeneous, Eigen::ComputeFullV);
    const Eigen::Matrix<double, 5, 1> x = svd.matrixV().col(4) / svd.matrixV()(4, 4);
    const auto found = relpose_1ac_ground_rapid(noisy);
    if (found.empty()) continue;
    ++compared;
    EXPECT_NEAR(found[0].tx, x(2), 1e-9) << "case " << i << " of seed 15";
    EXPECT_NEAR(found[0].tz, x(3), 1e-9) << "case " << i << " of seed 15";
    EXPECT_NEAR(found[0].sin_alpha * x(0), found[0].cos_alpha * x(1), 1e-9);
  }
  EXPECT_GT(compared, 4800);
}

TEST(Relpose1acGroundOptimal, NeverCostsMoreThanTheRapidSolver) {
  SceneGenerator scene(13);
  int compared = 0;
  for (int i = 0; i < 100000; ++i) {
    const double level = scene.uniform(0.0, 1.0);
    const AffineCorrespondence noisy =
        scene.with_noise(ground_case(scene).ac, 0.01 * level, 0.2 * level);
    const auto optimal = relpose_1ac_ground(noisy);
    const auto rapid = relpose_1ac_ground_rapid(noisy);
    if (optimal.empty() || rapid.empty()) continue;
    ++compared;
    ASSERT_LE(cost(optimal[0], noisy), cost(rapid[0], noisy) * (1.0 + 1e-9) + 1e-15)
        << "case " << i << " of seed 13";
  }
  EXPECT_GT(compared, 95000);
}

TEST(Relpose1acGroundOptimal, IsTheBruteForceMinimumOverTheAngle) {
  SceneGenerator scene(14);
  for (int i = 0; i < 200; ++i) {
    const AffineCorrespondence noisy = scene.with_noise(ground_case(scene).ac, 0.01, 0.2);
    const auto found = relpose_1ac_ground(noisy);
    if (found.empty()) continue;
    const PrintedSystem system = printed_system(noisy);
    const auto cost_at = [&system](double alpha) {
      const Eigen::Vector2d z(std::cos(alpha), std::sin(alpha));
      const Eigen::Matrix<double, 6, 1> rest = system.b - system.A.leftCols<2>() * z;
      const Eigen::Matrix<double, 6, 2> W = system.A.rightCols<2>();
      return (W * W.colPivHouseholderQr().solve(rest) - rest).squaredNorm();
    };
    double best = 0.0, alpha = 0.0, step = 1e-3;
    while (alpha < 6.2832) {
      if (cost_at(alpha) < cost_at(best)) best = alpha;
      alpha += step;
    }
    while (step > 1e-9) {
      if (cost_at(best + step) < cost_at(best)) best += step;
      if (cost_at(best - step) < cost_at(best)) best -= step;
      step *= 0.6;
    }
    EXPECT_NEAR(cost(found[0], noisy), cost_at(best), 1e-9) << "case " << i << " of seed 14";
  }
}

}  // namespace
}  // namespace oneac
