#include "oneac/robust/motion_evidence.h"

#include "oneac/geometry/homography.h"
#include "oneac/geometry/levelling.h"
#include "oneac/robust/one_ac_consensus.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace oneac {
namespace {

constexpr double kFocal = 700.0;
constexpr double kNoise = 0.15 / kFocal;
const Eigen::Matrix3d kLevel = Eigen::Matrix3d::Identity();
const Plane kRoad{Eigen::Vector3d::UnitY(), 1.0};  // lengths are camera heights
const Plane kFar{Eigen::Vector3d::UnitZ(), 500.0};

/// Points of a plane in a window of the image.
struct Region {
  double left, right, top, bottom;
};
constexpr Region kSky{-0.6, 0.6, -0.4, -0.02};
constexpr Region kNearRoad{-0.5, 0.5, 0.12, 0.38};

using Acs = std::vector<AffineCorrespondence>;

void add(Acs& acs, SceneGenerator& scene, const RelativePose& T, const Plane& plane, Region where,
         int count) {
  const Eigen::Matrix3d H = plane_induced_homography(T, plane);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d x(scene.uniform(where.left, where.right),
                            scene.uniform(where.top, where.bottom));
    const auto ac = correspondence_from_homography(H, x);
    if (ac) acs.push_back(scene.with_noise(*ac, kNoise, 0.03));
  }
}

RelativePose ahead(double length) {
  return {Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.0, 0.0, -length)};
}

RelativePose sideways(double length) {
  return {Eigen::Matrix3d::Identity(), Eigen::Vector3d(length, 0.0, 0.0)};
}

MotionEvidence judge(const Acs& acs, const std::vector<RelativePose>& moving = {},
                     const MotionPrior& prior = {}) {
  return judge_motion(acs, {}, {Eigen::Matrix3d::Identity(), moving}, kLevel, prior, {});
}

TEST(MotionEvidence, AFewNearPointsOutweighManyFarOnes) {
  SceneGenerator scene(1);
  for (const double length : {0.01, 0.03, 0.1, 0.16}) {
    Acs acs;
    add(acs, scene, ahead(length), kFar, kSky, 540);
    add(acs, scene, ahead(length), kRoad, kNearRoad, 40);
    const MotionEvidence evidence = judge(acs);
    ASSERT_EQ(evidence.model, MotionModel::kTranslation) << length << ' ' << evidence.log_odds;
    EXPECT_NEAR(evidence.length, length, 4.0 * evidence.length_sigma);
    EXPECT_GT(-evidence.pose.t.z(), 0.97) << length;
    EXPECT_GT(evidence.reasons.road, 0.0);
  }
}

TEST(MotionEvidence, AStandingCameraIsStillWithASigma) {
  SceneGenerator scene(2);
  Acs acs;
  add(acs, scene, ahead(0.0), kFar, kSky, 300);
  add(acs, scene, ahead(0.0), kRoad, kNearRoad, 60);
  const MotionEvidence evidence = judge(acs);
  EXPECT_EQ(evidence.model, MotionModel::kStill);
  EXPECT_EQ(evidence.pose.t.norm(), 0.0);
  EXPECT_LT(evidence.length_sigma, 0.002);
  EXPECT_LT(std::abs(evidence.length), 4.0 * evidence.length_sigma);
}

TEST(MotionEvidence, WithoutNearPointsTheLengthIsUnknown) {
  SceneGenerator scene(3);
  Acs acs;
  add(acs, scene, ahead(0.1), kFar, kSky, 300);
  const MotionEvidence evidence = judge(acs);
  EXPECT_EQ(evidence.model, MotionModel::kStill);
  EXPECT_TRUE(std::isinf(evidence.length_sigma));
  EXPECT_EQ(evidence.significance(), 0.0);
}

TEST(MotionEvidence, RockingIsARotation) {
  SceneGenerator scene(4);
  const RelativePose T{pitch_rotation(0.003), Eigen::Vector3d::Zero()};
  Acs acs;
  add(acs, scene, T, kFar, kSky, 200);
  add(acs, scene, T, kRoad, kNearRoad, 80);
  const MotionEvidence evidence = judge_motion(acs, {}, {T.R, {}}, kLevel, {}, {});
  EXPECT_EQ(evidence.model, MotionModel::kRotation);
  EXPECT_GT(evidence.rotation_odds, 100.0);
}

/// A bus that fills the middle and passes, before a road and houses that stand.
Acs bus_passes(SceneGenerator& scene, int on_road) {
  Acs acs;
  add(acs, scene, sideways(0.1), {Eigen::Vector3d::UnitZ(), 5.0}, {-0.3, 0.3, -0.3, 0.12}, 250);
  add(acs, scene, ahead(0.0), kFar, {-0.6, -0.32, -0.4, -0.02}, 40);
  add(acs, scene, ahead(0.0), kFar, {0.32, 0.6, -0.4, -0.02}, 40);
  add(acs, scene, ahead(0.0), kRoad, kNearRoad, on_road);
  return acs;
}

TEST(MotionEvidence, ABusBeforeAStandingCameraIsNoMotion) {
  SceneGenerator scene(5);
  const MotionEvidence evidence = judge(bus_passes(scene, 40), {sideways(1.0)});
  EXPECT_EQ(evidence.model, MotionModel::kStill) << evidence.log_odds;
  EXPECT_TRUE(evidence.reasons.one_mover);
  EXPECT_LT(evidence.reasons.resting, 0.0);
}

TEST(MotionEvidence, TheConsensusKeepsStandingWhileABusPasses) {
  SceneGenerator scene(6);
  const RobustResult result = one_ac_consensus(bus_passes(scene, 60), kLevel, kFocal, {});
  EXPECT_TRUE(is_stationary(result.status)) << to_string(result.status);
  ASSERT_TRUE(result.motion.has_value());
}

TEST(MotionEvidence, SeveralVehiclesThatCrossAreNoMotion) {
  SceneGenerator scene(7);
  Acs acs;
  add(acs, scene, sideways(0.1), {Eigen::Vector3d::UnitZ(), 6.0}, {-0.5, -0.2, -0.1, 0.1}, 60);
  add(acs, scene, sideways(-0.2), {Eigen::Vector3d::UnitZ(), 9.0}, {0.1, 0.4, -0.05, 0.08}, 60);
  add(acs, scene, ahead(0.0), kFar, kSky, 100);
  add(acs, scene, ahead(0.0), kRoad, kNearRoad, 30);
  EXPECT_EQ(judge(acs, {sideways(1.0)}).model, MotionModel::kStill);
}

TEST(MotionEvidence, AVehicleAheadAtAConstantGapDoesNotStopTheRoad) {
  SceneGenerator scene(8);
  const RelativePose T = ahead(0.5);
  Acs acs;
  add(acs, scene, ahead(0.0), {Eigen::Vector3d::UnitZ(), 8.0}, {-0.15, 0.15, -0.2, 0.1}, 150);
  add(acs, scene, T, kRoad, kNearRoad, 60);
  add(acs, scene, T, {Eigen::Vector3d::UnitX(), 4.0}, {0.3, 0.6, -0.3, 0.0}, 60);
  add(acs, scene, T, {-Eigen::Vector3d::UnitX(), 4.0}, {-0.6, -0.3, -0.3, 0.0}, 60);
  EXPECT_EQ(judge(acs, {ahead(1.0)}).model, MotionModel::kTranslation);
}

TEST(MotionEvidence, InertiaDecidesWhereThePointsHardlyDo) {
  SceneGenerator scene(9);
  Acs acs;
  add(acs, scene, ahead(0.004), kFar, kSky, 200);
  add(acs, scene, ahead(0.004), kRoad, {-0.5, 0.5, 0.2, 0.38}, 12);
  MotionPrior rolling;
  rolling.direction = -Eigen::Vector3d::UnitZ();
  rolling.direction_sigma = 0.1;
  rolling.length = 0.004;
  rolling.length_sigma = 0.001;
  MotionPrior resting = rolling;
  resting.length = 0.0;
  const double open = judge(acs).log_odds;
  EXPECT_GT(judge(acs, {}, rolling).log_odds, open);
  EXPECT_LT(judge(acs, {}, resting).log_odds, open);
}

TEST(MotionEvidence, TheGrowthOfPatchesIsPartOfIt) {
  SceneGenerator scene(10);
  Acs acs;
  add(acs, scene, ahead(0.08), kFar, kSky, 200);
  add(acs, scene, ahead(0.08), kRoad, kNearRoad, 60);
  const double with = judge(acs).log_odds;
  EXPECT_GT(judge(acs).reasons.affinity, 0.0);
  for (auto& ac : acs) ac.A.setIdentity();
  EXPECT_LT(judge(acs).log_odds, with);
}

TEST(MotionEvidence, ATiltedCameraSeesTheSame) {
  SceneGenerator scene(11);
  const Eigen::Matrix3d L = levelling_rotation({0.14, 0.02});
  const RelativePose T = unlevel(ahead(0.05), L);
  Acs acs;
  add(acs, scene, T, {L.transpose() * kFar.n, kFar.d}, {-0.6, 0.6, -0.3, 0.08}, 300);
  add(acs, scene, T, {L.transpose() * kRoad.n, kRoad.d}, {-0.5, 0.5, 0.25, 0.45}, 40);
  const MotionEvidence evidence =
      judge_motion(acs, {}, {Eigen::Matrix3d::Identity(), {}}, L, {}, {});
  EXPECT_EQ(evidence.model, MotionModel::kTranslation);
  EXPECT_NEAR(evidence.length, 0.05, 4.0 * evidence.length_sigma);
}

TEST(MotionEvidence, PointsWithWideSigmasSayLess) {
  SceneGenerator scene(12);
  Acs acs;
  add(acs, scene, ahead(0.02), kFar, kSky, 200);
  add(acs, scene, ahead(0.02), kRoad, kNearRoad, 40);
  const MotionHypotheses rest;
  const auto with = [&](double px) {
    return judge_motion(acs, std::vector<double>(acs.size(), px / kFocal), rest, kLevel, {}, {});
  };
  EXPECT_GT(with(0.2).log_odds, with(1.0).log_odds);
  EXPECT_GT(with(1.0).length_sigma, with(0.2).length_sigma);
}

TEST(MotionEvidence, BackwardsIsFoundByCheirality) {
  SceneGenerator scene(13);
  Acs acs;
  add(acs, scene, ahead(-0.1), kFar, kSky, 200);
  add(acs, scene, ahead(-0.1), kRoad, kNearRoad, 60);
  const MotionEvidence evidence = judge(acs, {ahead(1.0)});
  ASSERT_EQ(evidence.model, MotionModel::kTranslation);
  EXPECT_GT(evidence.pose.t.z(), 0.97);
}

TEST(MotionEvidence, RefusesMisuseAndSaysNothingOfNothing) {
  EXPECT_EQ(judge({}).model, MotionModel::kStill);
  Acs acs(20);
  EXPECT_THROW(static_cast<void>(judge_motion(acs, {1.0}, {}, kLevel, {}, {})),
               std::invalid_argument);
  MotionEvidenceOptions options;
  options.sigma = 0.0;
  EXPECT_THROW(options.validate(), std::invalid_argument);
  MotionPrior prior;
  prior.length_sigma = 0.0;
  EXPECT_THROW(prior.validate(), std::invalid_argument);
  const MotionEvidence evidence = judge(acs);  // all in one place
  EXPECT_TRUE(std::isfinite(evidence.log_odds));
}

}  // namespace
}  // namespace oneac
