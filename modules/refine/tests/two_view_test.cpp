#include "oneac/refine/two_view.h"

#include "refine_scenes.h"

#include "oneac/geometry/angular_errors.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace oneac {
namespace {

using test::expect_same_pose;
using test::kDegree;
using test::kFocal;
using test::refine;

RefineOptions with_affinities() {
  RefineOptions options;
  options.affine_terms_below = std::numeric_limits<int>::max();
  return options;
}

RefineOptions points_alone() {
  RefineOptions options;
  options.affine_terms_below = 0;
  return options;
}

TEST(RefineTwoView, ReachesTheTruthOfExactData) {
  SceneGenerator generator(11);
  for (const RefineOptions& options : {points_alone(), with_affinities()}) {
    for (int trial = 0; trial < 20; ++trial) {
      SCOPED_TRACE(trial);
      const auto scene = test::street(generator, 100, {});
      const RefineResult result =
          refine(scene, test::perturbed(generator, scene.truth, 0.05, 0.5), options);
      ASSERT_TRUE(result.usable()) << to_string(result.status);
      EXPECT_LT(rotation_error(result.pose.R, scene.truth.R), 1e-7);
      EXPECT_LT(direction_error(result.pose.t, scene.truth.t), 1e-6);
    }
  }
}

TEST(RefineTwoView, IsBetterThanItsStartOnNoisyData) {
  SceneGenerator generator(12);
  for (int trial = 0; trial < 50; ++trial) {
    SCOPED_TRACE(trial);
    const auto scene = test::street(generator, 200, {0.2, 0.05});
    const RelativePose start = test::perturbed(generator, scene.truth, 0.1, 1.0);
    const RefineResult result = refine(scene, start);
    ASSERT_TRUE(result.usable()) << to_string(result.status);
    EXPECT_LT(result.final_cost, result.initial_cost);
    EXPECT_LT(rotation_error(result.pose.R, scene.truth.R), rotation_error(start.R, scene.truth.R));
    EXPECT_LT(rotation_error(result.pose.R, scene.truth.R), 0.04 * kDegree);
    EXPECT_LT(direction_error(result.pose.t, scene.truth.t), 0.4 * kDegree);
  }
}

TEST(RefineTwoView, NeverRaisesItsCost) {
  SceneGenerator generator(13);
  for (int trial = 0; trial < 50; ++trial) {
    const auto scene = test::street(generator, 30, {5.0, 0.5});  // far from what it expects
    const RelativePose start = test::perturbed(generator, scene.truth, 5.0, 40.0);
    const RefineResult result = refine(scene, start, with_affinities());
    EXPECT_LE(result.final_cost, result.initial_cost) << trial;
    EXPECT_TRUE(result.pose.is_finite()) << trial;
  }
}

TEST(RefineTwoView, AffinitiesHelpWhenInliersAreFew) {
  SceneGenerator generator(14);
  double with = 0.0;
  double without = 0.0;
  RefineOptions precise = with_affinities();
  precise.affine_noise = 0.005;
  for (int trial = 0; trial < 100; ++trial) {
    const auto scene = test::street(generator, 10, {0.5, 0.005});
    const RelativePose start = test::perturbed(generator, scene.truth, 0.02, 0.2);
    with += direction_error(refine(scene, start, precise).pose.t, scene.truth.t);
    without += direction_error(refine(scene, start, points_alone()).pose.t, scene.truth.t);
  }
  EXPECT_LT(with, 0.9 * without);
}

TEST(RefineTwoView, UsesAffinitiesBelowTheGivenNumberOfInliers) {
  SceneGenerator generator(15);
  const auto scene = test::street(generator, 40, {0.2, 0.05});
  RefineOptions options;
  options.affine_terms_below = 41;
  EXPECT_TRUE(refine(scene, scene.truth, options).affine_used);
  options.affine_terms_below = 40;
  const RefineResult points = refine(scene, scene.truth, options);
  EXPECT_FALSE(points.affine_used);
  EXPECT_GT(points.affine_count, 30U);  // the flags are there all the same
  expect_same_pose(points.pose, refine(scene, scene.truth, points_alone()).pose);
}

TEST(RefineTwoView, GateThrowsOutWrongAffinities) {
  SceneGenerator generator(16);
  auto scene = test::street(generator, 60, {0.2, 0.02});
  Eigen::Matrix2d turn;
  turn << 0.0, -1.0, 1.0, 0.0;  // neighbourhoods matched a quarter turn off
  for (std::size_t i = 0; i < 20; ++i) scene.acs[i].A = turn * scene.acs[i].A;
  const RefineResult result = refine(scene, scene.truth, with_affinities());
  ASSERT_EQ(result.affine_consistent.size(), scene.acs.size());
  std::size_t right = 0;
  for (std::size_t i = 0; i < scene.acs.size(); ++i) {
    if (i < 20) {
      EXPECT_FALSE(result.affine_consistent[i]) << i;
    } else {
      right += result.affine_consistent[i] ? 1U : 0U;
    }
  }
  EXPECT_EQ(right, 40U);
  EXPECT_EQ(result.affine_count, right);
}

TEST(RefineTwoView, LooksAtInliersAlone) {
  SceneGenerator generator(17);
  auto scene = test::street(generator, 40, {0.2, 0.05});
  const RelativePose start = test::perturbed(generator, scene.truth, 0.05, 0.5);
  const RefineResult clean = refine(scene, start);
  std::vector<bool> inliers(scene.acs.size(), true);
  scene.acs.push_back({{3.0, 2.0}, {-0.3, 0.4}, Eigen::Matrix2d::Identity()});
  scene.acs.push_back({{std::nan(""), 0.0}, {0.0, 0.0}, Eigen::Matrix2d::Identity()});
  inliers.resize(scene.acs.size(), false);
  const RefineResult result = refine_two_view(scene.acs, inliers, start, kFocal, {});
  expect_same_pose(result.pose, clean.pose);
  EXPECT_EQ(result.shared_covariance, clean.shared_covariance);
  EXPECT_FALSE(result.affine_consistent.back());
}

TEST(RefineTwoView, KeepsTheLengthOfTheTranslation) {
  SceneGenerator generator(18);
  const auto scene = test::street(generator, 60, {0.2, 0.05});
  const RelativePose unit = test::perturbed(generator, scene.truth, 0.05, 0.5);
  const RelativePose metric{unit.R, 3.7 * unit.t};
  const RefineResult result = refine(scene, metric);
  ASSERT_TRUE(result.usable());
  EXPECT_NEAR(result.pose.t.norm(), 3.7, 1e-12);
  EXPECT_LT(direction_error(result.pose.t, refine(scene, unit).pose.t), 1e-9);
}

TEST(RefineTwoView, SurvivesASinglePlane) {
  SceneGenerator generator(19);
  for (int trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(trial);
    test::TwoViewScene scene;
    scene.truth = generator.planar_motion();
    scene.truth.t.normalize();
    const Plane ground = generator.ground();
    for (int i = 0; i < 60; ++i) {
      scene.acs.push_back(
          test::disturbed(generator, generator.on_plane(scene.truth, ground), {0.2, 0.05}));
    }
    const RelativePose start = test::perturbed(generator, scene.truth, 0.05, 0.5);
    const RefineResult result = refine(scene, start, with_affinities());
    ASSERT_TRUE(result.usable()) << to_string(result.status);
    EXPECT_TRUE(result.information.allFinite());
    EXPECT_LT(rotation_error(result.pose.R, scene.truth.R), 0.5 * kDegree);
  }
}

TEST(RefineTwoView, SurvivesPureRotation) {
  SceneGenerator generator(20);
  const RelativePose turn{rotation_from_vector({0.0, 0.05, 0.0}), Eigen::Vector3d::Zero()};
  test::TwoViewScene scene;
  for (int i = 0; i < 60; ++i) {
    scene.acs.push_back(
        test::disturbed(generator, test::seen_somewhere(generator, turn), {0.2, 0.05}));
  }
  const RefineResult result = refine(scene, {turn.R, Eigen::Vector3d::UnitZ()});
  ASSERT_TRUE(result.usable()) << to_string(result.status);
  EXPECT_LT(rotation_error(result.pose.R, turn.R), 0.2 * kDegree);
  EXPECT_TRUE(result.information.allFinite());
}

TEST(RefineTwoView, ADirectionThatIsExpectedCountsAsItsSigmaSays) {
  SceneGenerator generator(17);
  const auto scene = test::street(generator, 200, {0.2, 0.05});
  const std::vector<bool> all(scene.acs.size(), true);
  const Eigen::Vector3d aside =
      (scene.truth.t.normalized() + Eigen::Vector3d(0.2, 0, 0)).normalized();
  const auto off = [&](double sigma) {
    const RefineResult result =
        refine_two_view(scene.acs, all, scene.truth, kFocal, points_alone(), {{aside, sigma}, {}});
    EXPECT_TRUE(result.usable());
    return direction_error(result.pose.t, aside);
  };
  EXPECT_LT(off(1e-4), 0.1 * kDegree);
  EXPECT_GT(off(10.0), 4.0 * kDegree) << "the images know better";
}

/// A street whose first twenty points are sharp and the others blurred, with the 1σ of all [-].
struct SharpAndBlurred {
  test::TwoViewScene scene;
  std::vector<double> sigmas;
};

SharpAndBlurred sharp_and_blurred(SceneGenerator& generator) {
  constexpr double kSharp_px = 0.05, kBlurred_px = 0.8;
  SharpAndBlurred both;
  both.scene = test::street(generator, 200, {});
  for (std::size_t i = 0; i < both.scene.acs.size(); ++i) {
    const double px = i < 20 ? kSharp_px : kBlurred_px;
    both.scene.acs[i] = test::disturbed(generator, both.scene.acs[i], {px, 0.05});
    both.sigmas.push_back(px / kFocal);
  }
  return both;
}

TEST(RefineTwoView, PointsThatTellTheirNoiseCountByIt) {
  SceneGenerator generator(41);
  double alike = 0.0, weighed = 0.0;
  for (int trial = 0; trial < 40; ++trial) {
    const auto [scene, sigmas] = sharp_and_blurred(generator);
    const std::vector<bool> all(scene.acs.size(), true);
    const auto error = [&](const std::vector<double>& of_points) {
      const RefineResult result =
          refine_two_view(scene.acs, all, scene.truth, kFocal, points_alone(), {{}, of_points});
      return direction_error(result.pose.t, scene.truth.t);
    };
    alike += error({});
    weighed += error(sigmas);
  }
  EXPECT_LT(weighed, 0.5 * alike);
}

TEST(RefineTwoView, APointWhoseNoiseIsUnknownCountsAsUsual) {
  SceneGenerator generator(42);
  const auto scene = test::street(generator, 60, {0.2, 0.05});
  const std::vector<bool> all(scene.acs.size(), true);
  const std::vector<double> unknown(scene.acs.size(), 0.0);
  const RefineResult told = refine_two_view(scene.acs, all, scene.truth, kFocal, {}, {{}, unknown});
  test::expect_same_pose(told.pose, refine(scene, scene.truth).pose);
  EXPECT_THROW((void)refine_two_view(scene.acs, all, scene.truth, kFocal, {}, {{}, {0.001}}),
               std::invalid_argument);
}

TEST(RefineTwoView, GivesTheSameBitsEachTime) {
  SceneGenerator generator(21);
  const auto scene = test::street(generator, 45, {0.3, 0.05});
  const RelativePose start = test::perturbed(generator, scene.truth, 0.1, 1.0);
  const RefineResult first = refine(scene, start);
  const RefineResult second = refine(scene, start);
  expect_same_pose(first.pose, second.pose);
  EXPECT_EQ(first.final_cost, second.final_cost);
  EXPECT_EQ(first.information, second.information);
}

/// eᵀ Λ e, e the error of the pose and Λ its information.
double normalised_error(const test::TwoViewScene& scene, const RefineOptions& options) {
  const RefineResult result = refine(scene, scene.truth, options);
  EXPECT_LT((result.information.rightCols<3>() * result.pose.t).norm(),
            1e-9 * result.information.norm());
  const Eigen::Matrix3d dR = scene.truth.R * result.pose.R.transpose();
  Eigen::Matrix<double, 6, 1> error;
  error << 0.5 * (dR(2, 1) - dR(1, 2)), 0.5 * (dR(0, 2) - dR(2, 0)), 0.5 * (dR(1, 0) - dR(0, 1)),
      scene.truth.t - result.pose.t;
  return error.dot(result.information * error);
}

double mean_normalised_error(const test::Noise& noise, const RefineOptions& options) {
  SceneGenerator generator(22);
  double sum = 0.0;
  constexpr int kTrials = 100;
  for (int trial = 0; trial < kTrials; ++trial) {
    sum += normalised_error(test::street(generator, 400, noise), options);
  }
  return sum / kTrials;
}

/// Houses far away under the same noise, and a few near points that alone tell the direction.
test::TwoViewScene far_scenery(SceneGenerator& generator, std::size_t near,
                               const test::Noise& noise) {
  test::TwoViewScene scene = test::street(generator, 200, {});
  for (std::size_t i = 0; i < scene.acs.size(); ++i) {
    AffineCorrespondence& ac = scene.acs[i];
    if (i >= near) {
      const Eigen::Vector3d X = scene.truth.R * ac.x1.homogeneous() + 0.001 * scene.truth.t;
      ac.x2 = X.hnormalized();
    }
    ac = test::disturbed(generator, ac, noise);
  }
  return scene;
}

TEST(RefineTwoView, InformationFollowsTheScatter) {
  // Chi-squared with five degrees of freedom: a mean of 100 strays by 0.3 (1σ).
  constexpr double kTolerance = 1.5;
  EXPECT_NEAR(mean_normalised_error({0.2, 0.05}, points_alone()), 5.0, kTolerance);
  EXPECT_NEAR(mean_normalised_error({0.2, 0.05}, with_affinities()), 5.0, kTolerance);
  RefineOptions wrong_noise = points_alone();  // half of what the points have
  wrong_noise.loss_sigmas = 4.0;
  EXPECT_NEAR(mean_normalised_error({0.4, 0.05}, wrong_noise), 5.0, kTolerance);
}

TEST(RefineTwoView, InformationOfAFewNearPointsIsNotThatOfTheirResiduals) {
  SceneGenerator generator(23);
  std::vector<double> errors;
  for (int trial = 0; trial < 200; ++trial) {
    errors.push_back(normalised_error(far_scenery(generator, 8, {0.2, 0.05}), points_alone()));
  }
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[100], 6.0) << "median; of chi-squared with five degrees of freedom 4.4";
  EXPECT_LT(errors[190], 15.0) << "one of twenty; of chi-squared 11";
}

/// A street whose second view was taken row by row by a camera that turns: each row sees it turned
/// by its share of what the camera turns from the first row to the last.
test::TwoViewScene rolling_street(SceneGenerator& generator, double turn_rad) {
  test::TwoViewScene scene = test::street(generator, 400, {0.2, 0.05});
  const Eigen::Vector3d axis =
      turn_rad * Eigen::Vector3d(generator.normal(1.0), generator.normal(1.0), 0.0);
  for (AffineCorrespondence& ac : scene.acs) {
    const Eigen::Vector3d seen = rotation_from_vector(ac.x2.y() * axis) * ac.x2.homogeneous();
    ac.x2 = seen.hnormalized();
  }
  return scene;
}

/// eᵀ C⁻¹ e of the direction, C with what neighbours share.
double error_of_direction(const test::TwoViewScene& scene) {
  const RefineResult result = refine(scene, scene.truth, points_alone());
  Eigen::Matrix<double, 3, 2> across;
  across.col(0) = result.pose.t.unitOrthogonal();
  across.col(1) = result.pose.t.cross(across.col(0));
  Eigen::Matrix<double, 6, 6> regular = result.information;
  regular.bottomRightCorner<3, 3>() += regular.trace() * result.pose.t * result.pose.t.transpose();
  const Eigen::Matrix<double, 6, 6> covariance = regular.inverse() + result.shared_covariance;
  const Eigen::Vector2d off = across.transpose() * scene.truth.t;
  const Eigen::Matrix2d seen = across.transpose() * covariance.bottomRightCorner<3, 3>() * across;
  return off.dot(seen.inverse() * off);
}

TEST(RefineTwoView, ErrorsThatNeighboursShareAreStated) {
  SceneGenerator generator(24);
  std::vector<double> errors;
  for (int trial = 0; trial < 200; ++trial) {
    errors.push_back(error_of_direction(rolling_street(generator, 0.003)));
  }
  std::sort(errors.begin(), errors.end());
  EXPECT_GT(errors[100], 0.3) << "median; of chi-squared with two degrees of freedom 1.4";
  EXPECT_LT(errors[180], 9.0) << "one of ten; of chi-squared 4.6, as if they were independent 28";
}

}  // namespace
}  // namespace oneac
