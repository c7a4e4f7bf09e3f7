#include "oneac/solvers/relpose_1ac_vertical.h"

#include "one_ac/upright_half_angles.h"
#include "point_solver_tools.h"

#include "oneac/solvers/gravity.h"
#include "oneac/solvers/relpose_1ac_planar.h"
#include "oneac/test_support/allocation_counter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace oneac {
namespace {

using namespace test;

/// A yaw and any translation: up to 45° uphill or downhill.
RelativePose upright_motion(SceneGenerator& scene) {
  RelativePose T = scene.planar_motion();
  T.t.y() = scene.uniform(-1.0, 1.0) * T.t.norm();
  return T;
}

struct Case {
  RelativePose T;
  AffineCorrespondence ac;
};

Case upright_case(SceneGenerator& scene) {
  const RelativePose T = upright_motion(scene);
  return {T, scene.on_plane(T, scene.any_plane())};
}

double equations(const RelativePose& T, const AffineCorrespondence& ac) {
  const Eigen::Matrix3d E = essential_matrix(T);
  return std::abs(ac.x2.homogeneous().dot(E * ac.x1.homogeneous())) +
         affine_epipolar_residual(E, ac).norm();
}

/// The three equations on t at a yaw, as the derivative of x2ᵀ [t]× R x1 along the patch: by finite
/// differences, independent of any formula of the solver.
Eigen::Matrix3d numeric_system(const AffineCorrespondence& ac, double yaw) {
  const Eigen::Matrix3d R = yaw_rotation(std::cos(yaw), std::sin(yaw));
  const auto row = [&](const Eigen::Vector2d& d) -> Eigen::Vector3d {
    return (R * (ac.x1 + d).homogeneous()).cross((ac.x2 + ac.A * d).homogeneous());
  };
  constexpr double kStep = 1e-4;  // the rows are quadratic in it: differences are exact
  Eigen::Matrix3d M;
  M.row(0) = row({0.0, 0.0});
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector2d d = kStep * Eigen::Vector2d::Unit(k);
    M.row(k + 1) = (row(d) - row(-d)) / (2.0 * kStep);
  }
  return M;
}

TEST(Relpose1acVertical, DeterminantOfTheEquationsIsTheDocumentedQuartic) {
  SceneGenerator scene(1);
  for (int i = 0; i < 200; ++i) {
    AffineCorrespondence ac = upright_case(scene).ac;
    ac.x1.x() = ac.x2.x() = 0.0;  // straight ahead in both views
    const double y = ac.x1.y(), v = ac.x2.y(), sum = v + y, difference = v - y;
    const double a1 = ac.A(0, 0), a2 = ac.A(0, 1), a3 = ac.A(1, 0), a4 = ac.A(1, 1);
    for (const double tau : {-1.3, -0.2, 0.01, 0.4, 2.0}) {
      const double quartic = -a2 * sum * sum * std::pow(tau, 4) -
                             2.0 * sum * (a1 + a4) * std::pow(tau, 3) - 4.0 * a3 * tau * tau +
                             2.0 * difference * (a1 - a4) * tau + a2 * difference * difference;
      const double determinant = numeric_system(ac, 2.0 * std::atan(tau)).determinant();
      const double scale = std::pow(1.0 + tau * tau, 2);
      EXPECT_NEAR(determinant * scale, quartic, 1e-9 * scale) << "scene " << i << " of seed 1";
    }
  }
}

TEST(Relpose1acVertical, HalfAnglesAreTheRootsOfTheQuarticBySturmToo) {
  SceneGenerator scene(2);
  int many = 0;
  for (int i = 0; i < 1000; ++i) {
    const AffineCorrespondence ac = upright_case(scene).ac;
    const internal::AheadCorrespondence ahead{ac.x1.y(),  ac.x2.y(),  ac.A(0, 0),
                                              ac.A(0, 1), ac.A(1, 0), ac.A(1, 1)};
    const auto roots = internal::upright_half_angles(ahead);
    many += roots.size() == 4 ? 1 : 0;
    for (const double tau : roots) {
      const double scale = std::pow(1.0 + tau * tau, 2);
      AffineCorrespondence turned = ac;
      turned.x1.x() = turned.x2.x() = 0.0;
      EXPECT_LT(std::abs(numeric_system(turned, 2.0 * std::atan(tau)).determinant()), 1e-9 * scale)
          << "scene " << i << " of seed 2, root " << tau;
    }
  }
  EXPECT_GT(many, 100);
}

TEST(Relpose1acVertical, TruthIsAmongTheCandidatesOfTenThousandScenes) {
  SceneGenerator scene(3);
  for (int i = 0; i < 10000; ++i) {
    const Case c = upright_case(scene);
    EXPECT_LT(nearest_pose(relpose_1ac_vertical(c.ac), c.T), kExact)
        << "scene " << i << " of seed 3";
  }
}

TEST(Relpose1acVertical, ShortTranslationsKeepTheTruth) {
  SceneGenerator scene(4);
  for (int i = 0; i < 1000; ++i) {
    RelativePose T = upright_motion(scene);
    T.t *= 0.01;
    const auto ac = scene.on_plane(T, scene.any_plane());
    EXPECT_LT(nearest_pose(relpose_1ac_vertical(ac), T), 1e-6) << "scene " << i << " of seed 4";
  }
}

TEST(Relpose1acVertical, EveryCandidateSatisfiesTheEquationsBeforeBothCameras) {
  SceneGenerator scene(5);
  for (int i = 0; i < 1000; ++i) {
    const Case c = upright_case(scene);
    for (const UprightPose& pose : relpose_1ac_vertical(c.ac)) {
      EXPECT_LT(equations(pose.pose(), c.ac), 1e-9) << "scene " << i << " of seed 5";
      EXPECT_NEAR(pose.t.norm(), 1.0, 1e-14);
      EXPECT_NEAR(std::hypot(pose.cos_alpha, pose.sin_alpha), 1.0, 1e-14);
      EXPECT_TRUE(triangulate_in_front(pose.pose(), c.ac)) << "scene " << i << " of seed 5";
    }
  }
}

TEST(Relpose1acVertical, PlanarMotionIsASpecialCaseAndTheHorizonIsNone) {
  SceneGenerator scene(6);
  for (int i = 0; i < 300; ++i) {
    const RelativePose planar = scene.planar_motion();
    const auto ac = scene.on_plane(planar, scene.any_plane());
    EXPECT_LT(nearest_pose(relpose_1ac_vertical(ac), planar), kExact) << "scene " << i;
    const RelativePose T = upright_motion(scene);
    const Plane plane{Eigen::Vector3d(0.3, 0.4, 0.9).normalized(), 10.0};
    const auto level = on_horizon(T, plane, scene.uniform(-0.5, 0.5));
    EXPECT_LT(nearest_pose(relpose_1ac_vertical(level), T), kExact) << "scene " << i;
  }
}

TEST(Relpose1acVertical, TiltedCamerasOfKnownVerticalAreTurnedUpright) {
  SceneGenerator scene(7);
  for (int i = 0; i < 300; ++i) {
    const Case c = upright_case(scene);
    const Eigen::Matrix3d Q1 = pitch_rotation(scene.uniform(-0.2, 0.2));
    const Eigen::Matrix3d Q2 = roll_rotation(scene.uniform(-0.2, 0.2));
    const auto tilted = rotate_views(c.ac, Q1, Q2);
    if (!tilted) continue;
    const RelativePose T{Q2 * c.T.R * Q1.transpose(), Q2 * c.T.t};
    const Eigen::Vector3d down1 = Q1.col(1), down2 = Q2.col(1);
    EXPECT_LT(nearest_pose(solve_tilted(*tilted, down1, down2, relpose_1ac_vertical), T), kExact)
        << "scene " << i << " of seed 7";
  }
}

TEST(Relpose1acVertical, ManyCorrespondencesRecoverTheMotionAndUseWeights) {
  SceneGenerator scene(8);
  for (int i = 0; i < 200; ++i) {
    const RelativePose T = upright_motion(scene);
    auto acs = scattered(scene, T, 2 + i % 6);
    std::vector<double> weights(acs.size(), 1.0);
    acs.push_back(scene.with_noise(acs[0], 0.1, 0.3));
    weights.push_back(0.0);
    const auto found = relpose_nac_vertical(acs, weights.data());
    ASSERT_EQ(found.size(), 1u) << "scene " << i << " of seed 8";
    EXPECT_LT(pose_error(found[0].pose(), T), kExact) << "scene " << i << " of seed 8";
  }
}

TEST(Relpose1acVertical, LeastSquaresIsAMinimumOfTheEquations) {
  SceneGenerator scene(9);
  const RelativePose T = upright_motion(scene);
  auto acs = scattered(scene, T, 12);
  for (auto& ac : acs) ac = scene.with_noise(ac, 1e-3, 1e-2);
  const auto found = relpose_nac_vertical(acs);
  ASSERT_EQ(found.size(), 1u);
  const auto cost = [&acs](const RelativePose& pose) {
    double sum = 0.0;
    const Eigen::Matrix3d E = essential_matrix(pose);
    for (const auto& ac : acs) {
      sum += std::pow(ac.x2.homogeneous().dot(E * ac.x1.homogeneous()), 2) +
             affine_epipolar_residual(E, ac).squaredNorm();
    }
    return sum;
  };
  const RelativePose best = found[0].pose();
  for (const double step : {-1e-4, 1e-4}) {
    const RelativePose turned{yaw_rotation(std::cos(step), std::sin(step)) * best.R, best.t};
    EXPECT_GT(cost(turned), cost(best));
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Matrix3d Q = rotation_from_vector(step * Eigen::Vector3d::Unit(axis));
      if ((Q * best.t - best.t).norm() < 0.1 * std::abs(step)) continue;
      EXPECT_GT(cost({best.R, Q * best.t}), cost(best));
    }
  }
  EXPECT_LT(pose_error(best, T), 0.3);
}

TEST(Relpose1acVertical, FaultsAndPureRotationsGiveNothing) {
  SceneGenerator scene(10);
  const Case c = upright_case(scene);
  for (const Fault& fault : faults(c.ac)) {
    EXPECT_TRUE(relpose_1ac_vertical(fault.ac).empty()) << fault.name;
    EXPECT_TRUE(relpose_nac_vertical(AcSpan(&fault.ac, 1)).empty()) << fault.name;
  }
  for (int i = 0; i < 1000; ++i) {
    const auto turned = pure_rotation(scene.uniform(-0.5, 0.5), scene.image_point());
    EXPECT_TRUE(relpose_1ac_vertical(turned).empty()) << "case " << i << " of seed 10";
  }
  EXPECT_TRUE(relpose_nac_vertical(AcSpan()).empty());
}

TEST(Relpose1acVertical, NeverReturnsNaNOnExtremeNumbers) {
  SceneGenerator scene(11);
  for (int i = 0; i < 20000; ++i) {
    const AffineCorrespondence ac = extreme_correspondence(scene);
    for (const UprightPose& pose : relpose_1ac_vertical(ac)) {
      EXPECT_TRUE(pose.pose().is_finite()) << "case " << i << " of seed 11";
    }
  }
}

TEST(Relpose1acVertical, DoesNotAllocate) {
  SceneGenerator scene(12);
  const Case c = upright_case(scene);
  const std::vector<AffineCorrespondence> two{c.ac, scene.on_plane(c.T, scene.any_plane())};
  const std::size_t before = allocation_count();
  const auto one = relpose_1ac_vertical(c.ac);
  const auto many = relpose_nac_vertical(AcSpan(two.data(), 2));
  EXPECT_EQ(allocation_count(), before);
  EXPECT_FALSE(one.empty() || many.empty());
}

}  // namespace
}  // namespace oneac
