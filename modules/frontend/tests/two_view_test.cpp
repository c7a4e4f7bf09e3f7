#include "two_view/two_view.h"

#include "two_view/normalised_pair.h"

#include "oneac/frontend/front_end_options.h"
#include "oneac/geometry/angular_errors.h"
#include "oneac/geometry/homography.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <cmath>

namespace oneac {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kFocal = 700.0;
const RelativePose kDriven{yaw_rotation(std::cos(0.02), std::sin(0.02)), {0.02, 0.0, -1.0}};

/// Road and house fronts on both sides, seen with noise of a fifth of a pixel.
TrackedPair street(const RelativePose& T_2_1) {
  SceneGenerator random(5);
  const auto noise = [&random] { return random.uniform(-0.35, 0.35) / kFocal; };
  TrackedPair pair;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const double side = i % 2 == 0 ? 4.0 : -4.0;
    const bool on_road = i % 3 == 0;
    const Eigen::Vector3d X(on_road ? random.uniform(-3.0, 3.0) : side,
                            on_road ? 1.5 : random.uniform(-3.0, 1.4), random.uniform(5.0, 40.0));
    const Plane plane = on_road ? Plane{Eigen::Vector3d::UnitY(), 1.5}
                                : Plane{Eigen::Vector3d::UnitX() * (side / 4.0), 4.0};
    const auto ac =
        correspondence_from_homography(plane_induced_homography(T_2_1, plane), X.head<2>() / X.z());
    if (!ac) continue;
    Correspondence full;
    static_cast<AffineCorrespondence&>(full) = *ac;
    full.x2 += Eigen::Vector2d(noise(), noise());
    full.track = i;
    pair.correspondences.push_back(full);
  }
  return pair;
}

TwoViewEstimator estimator(const FrontEndOptions& options = {}) {
  return {options, make_initialiser(options.initialiser)};
}

TwoViewPrior prior() {
  TwoViewPrior prior;
  prior.expected = {pitch_rotation(0.01), {0.0, 0.0, -3.0}};
  prior.focal_px = kFocal;
  return prior;
}

TEST(TwoView, FindsTheMotionWithAUnitDirection) {
  const TwoView seen = estimator().estimate(street(kDriven), prior());
  EXPECT_EQ(seen.status, StepStatus::kOk);
  EXPECT_NEAR(seen.pose.t.norm(), 1.0, 1e-9);
  EXPECT_LT(rotation_error(seen.pose.R, kDriven.R), 0.05 * kDegree);
  EXPECT_LT(direction_error(seen.pose.t, kDriven.t), 0.5 * kDegree);
  EXPECT_EQ(seen.inliers.size(), seen.pair.size());
  EXPECT_GT(seen.inlier_count, seen.pair.size() * 9 / 10);
}

TEST(TwoView, CarriesACovarianceThatKnowsNothingAlongTheTranslation) {
  const TwoView seen = estimator().estimate(street(kDriven), prior());
  EXPECT_TRUE(seen.covariance.isApprox(seen.covariance.transpose()));
  Eigen::Matrix<double, 6, 1> along = Eigen::Matrix<double, 6, 1>::Zero();
  along.tail<3>() = seen.pose.t.normalized();
  EXPECT_LT((seen.covariance * along).norm(), 1e-6 * seen.covariance.norm());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(seen.covariance);
  EXPECT_GT(solver.eigenvalues()(1), 0.0) << "rank five";
  const double turn = std::sqrt(seen.covariance.topLeftCorner<3, 3>().trace());
  EXPECT_GT(turn, rotation_error(seen.pose.R, kDriven.R) / 5.0);
  EXPECT_LT(turn, 0.1 * kDegree);
}

TEST(TwoView, KeepsTheCovarianceOfTheInitialiserWithoutRefinement) {
  FrontEndOptions options;
  options.refine_enabled = false;
  const TwoView seen = estimator(options).estimate(street(kDriven), prior());
  EXPECT_EQ(seen.status, StepStatus::kOk);
  EXPECT_GT(seen.covariance.trace(), 0.0);
}

TEST(TwoView, GoesOnAsExpectedWhereTheImagesDoNotTell) {
  TrackedPair few = street(kDriven);
  few.correspondences.resize(2);
  const TwoView seen = estimator().estimate(few, prior());
  EXPECT_EQ(seen.status, StepStatus::kPredicted);
  EXPECT_EQ(seen.pose.R, prior().expected.R);
  EXPECT_NEAR((seen.pose.t - prior().expected.t.normalized()).norm(), 0.0, 1e-15);
  EXPECT_TRUE(seen.inliers.empty());
  EXPECT_TRUE(seen.covariance.isZero(0.0));
}

TEST(TwoView, StandsWhenTheTrackerSaysSo) {
  TrackedPair pair = street({});
  pair.standing = true;
  const TwoView seen = estimator().estimate(pair, prior());
  EXPECT_EQ(seen.status, StepStatus::kNoMotion);
  EXPECT_TRUE(seen.pose.R.isIdentity(0.0));
  EXPECT_TRUE(seen.pose.t.isZero(0.0));
  EXPECT_EQ(seen.inlier_count, pair.size());
}

TEST(CovarianceBeside, InvertsWhatIsKnown) {
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  information.diagonal() << 1e6, 2e6, 4e6, 1e4, 2e4, 0.0;
  const auto covariance = covariance_beside(information, {0.0, 0.0, -2.0});
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(covariance(i, i) * information(i, i), 1.0, 1e-9);
  EXPECT_NEAR(covariance(5, 5), 0.0, 1e-15);
  EXPECT_TRUE(covariance_beside(Eigen::Matrix<double, 6, 6>::Zero(), {0, 0, 1}).isZero(0.0));
  information(0, 0) = std::nan("");
  EXPECT_TRUE(covariance_beside(information, {0, 0, 1}).isZero(0.0));
}

TEST(NormalisedPair, BringsEveryUnitAlong) {
  CameraFrame frame;
  frame.camera = {640, 480, 500.0, 500.0, 320.0, 240.0, {}};
  frame.image = GreyImage(640, 480, 77);
  Correspondence px;
  px.x1 = {320.0, 240.0};
  px.x2 = {370.0, 240.0};
  px.track = 9;
  px.point_sigma = 0.5;
  px.affine_sigma = 0.03;
  px.perspective = Eigen::Matrix2d::Identity() * 25.0;
  px.depth = MeasuredDepth{12.0, 0.02};
  const TrackedPair pair = normalised({{px}, true}, frame.camera, frame);
  const Correspondence& ac = pair.correspondences.at(0);
  EXPECT_TRUE(pair.standing);
  EXPECT_LT((ac.x2 - Eigen::Vector2d(0.1, 0.0)).norm(), 1e-12);
  EXPECT_EQ(ac.track, 9U);
  EXPECT_DOUBLE_EQ(ac.point_sigma, 0.001);
  EXPECT_DOUBLE_EQ(ac.affine_sigma, 0.03);
  EXPECT_DOUBLE_EQ(ac.perspective(0, 0), 1e-4);
  EXPECT_EQ(ac.grey, 77);
  ASSERT_TRUE(ac.depth.has_value());
  EXPECT_EQ(ac.depth->z, 12.0);
}

}  // namespace
}  // namespace oneac
