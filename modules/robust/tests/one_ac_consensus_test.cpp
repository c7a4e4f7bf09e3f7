#include "oneac/robust/one_ac_consensus.h"

#include "oneac/geometry/angular_errors.h"
#include "oneac/geometry/homography.h"
#include "oneac/geometry/levelling.h"
#include "oneac/robust/pitch_sweep.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace oneac {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kFocal = 700.0;
const Eigen::Matrix3d kLevel = Eigen::Matrix3d::Identity();

/// Road and walls with half a pixel of noise and noisy affinities; `outliers` of a hundred are
/// wrong.
std::vector<AffineCorrespondence> street(SceneGenerator& scene, const RelativePose& T,
                                         int outliers = 20) {
  std::vector<AffineCorrespondence> acs;
  const Plane ground = scene.ground();
  for (int i = 0; i < 300; ++i) {
    const Plane plane = i % 3 == 0 ? ground : scene.any_plane();
    acs.push_back(scene.with_noise(scene.on_plane(T, plane), 0.5 / kFocal, 0.02));
    if (i % 100 < outliers) acs.back().x2 = scene.image_point();
  }
  return acs;
}

/// The plane that a car in a street sees at an image point: road, facades beside it, the street's
/// end.
Plane plane_at(const Eigen::Vector2d& x, double side, double end) {
  const double road = x.y() > 0.03 ? 1.65 / x.y() : 1e9;
  const double facade = side / std::max(1e-3, std::abs(x.x()));
  if (road < facade) return {Eigen::Vector3d::UnitY(), 1.65};
  if (facade < 40.0) return {std::copysign(1.0, x.x()) * Eigen::Vector3d::UnitX(), side};
  return {Eigen::Vector3d::UnitZ(), end};
}

/// A wide, flat image of such a street, in metres, with 0.3 px of noise.
std::vector<AffineCorrespondence> seen_by_a_car(SceneGenerator& scene, const RelativePose& T) {
  std::vector<AffineCorrespondence> acs;
  const double width = scene.uniform(4.0, 12.0);
  while (acs.size() < 400) {
    const Eigen::Vector2d x(scene.uniform(-0.8, 0.8), scene.uniform(-0.24, 0.24));
    const Plane plane = plane_at(x, width * scene.uniform(0.7, 1.3), scene.uniform(30.0, 80.0));
    const auto ac = correspondence_from_homography(plane_induced_homography(T, plane), x);
    if (ac) acs.push_back(scene.with_noise(*ac, 0.3 / kFocal, 0.03));
  }
  return acs;
}

void expect_close(const RobustResult& result, const RelativePose& truth, int trial) {
  ASSERT_EQ(result.status, PoseStatus::kOk) << "trial " << trial;
  EXPECT_LT(rotation_error(result.pose.R, truth.R), 0.2 * kDegree) << "trial " << trial;
  EXPECT_LT(direction_error(result.pose.t, truth.t), 2.0 * kDegree) << "trial " << trial;
}

TEST(OneAcConsensus, FindsPlanarMotionAmongOutliers) {
  SceneGenerator scene(21);
  for (int trial = 0; trial < 10; ++trial) {
    const RelativePose T = scene.planar_motion();
    expect_close(one_ac_consensus(street(scene, T, 50), kLevel, kFocal, {}), T, trial);
  }
}

TEST(OneAcConsensus, CoversTheSuspensionsPitchBetweenTheFrames) {
  SceneGenerator scene(22);
  for (double pitch : {-1.7, -0.8, 0.75, 1.6}) {
    RelativePose T = scene.planar_motion();
    T.R = pitch_rotation(pitch * kDegree) * T.R;
    expect_close(one_ac_consensus(street(scene, T), kLevel, kFocal, {}), T,
                 static_cast<int>(10 * pitch));
  }
}

TEST(OneAcConsensus, TakesNoWrongBasinThatAWideBoundForgives) {
  SceneGenerator scene(28);
  ConsensusOptions wide;
  wide.threshold_px = 3.0;
  for (int trial = 0; trial < 400; ++trial) {
    const double yaw = scene.uniform(-0.05, 0.05);
    const double way = scene.uniform(0.2, 0.8);  // [m]
    RelativePose T{yaw_rotation(std::cos(yaw), std::sin(yaw)),
                   way * Eigen::Vector3d(scene.uniform(-0.1, 0.1), 0.0, -1.0)};
    T.R = pitch_rotation(scene.uniform(-0.6, 0.6) * kDegree) *
          roll_rotation(scene.uniform(-0.3, 0.3) * kDegree) * T.R;
    const RobustResult result = one_ac_consensus(seen_by_a_car(scene, T), kLevel, kFocal, wide);
    EXPECT_LT(rotation_error(result.pose.R, T.R), 1.0 * kDegree) << "trial " << trial;
    EXPECT_LT(direction_error(result.pose.t, T.t), 15.0 * kDegree) << "trial " << trial;
  }
}

TEST(OneAcConsensus, RemovesTheCamerasTiltAndPutsItBack) {
  SceneGenerator scene(23);
  const Eigen::Matrix3d L = levelling_rotation({8.0 * kDegree, 1.0 * kDegree});
  for (int trial = 0; trial < 5; ++trial) {
    const RelativePose T = unlevel(scene.planar_motion(), L);
    expect_close(one_ac_consensus(street(scene, T), L, kFocal, {}), T, trial);
  }
}

TEST(OneAcConsensus, ReportsAStandingCamera) {
  SceneGenerator scene(24);
  std::vector<AffineCorrespondence> acs(100);
  for (auto& ac : acs) {
    ac.x1 = scene.image_point();
    ac.x2 = ac.x1 + Eigen::Vector2d(scene.normal(0.1 / kFocal), scene.normal(0.1 / kFocal));
  }
  const RobustResult result = one_ac_consensus(acs, kLevel, kFocal, {});
  EXPECT_EQ(result.status, PoseStatus::kNoMotion);
  EXPECT_EQ(result.pose.t.norm(), 0.0);
  EXPECT_TRUE(result.pose.R.isIdentity());
  EXPECT_GT(result.inlier_count, 90U);
}

TEST(OneAcConsensus, ReportsARockingCameraAsRotationWithoutTranslation) {
  SceneGenerator scene(29);
  const RelativePose T{pitch_rotation(0.15 * kDegree), Eigen::Vector3d::Zero()};
  std::vector<AffineCorrespondence> acs;
  for (int i = 0; i < 100; ++i) {
    acs.push_back(scene.with_noise(scene.on_plane(T, scene.any_plane()), 0.15 / kFocal, 0.01));
    if (i % 10 == 0) acs.back().x2 = scene.image_point();  // traffic
  }
  const RobustResult result = one_ac_consensus(acs, kLevel, kFocal, {});
  EXPECT_EQ(result.status, PoseStatus::kPureRotation);
  EXPECT_EQ(result.pose.t.norm(), 0.0);
  EXPECT_LT(rotation_error(result.pose.R, T.R), 0.01 * kDegree);
}

TEST(OneAcConsensus, RefusesTooFewCorrespondencesAndNoise) {
  EXPECT_EQ(one_ac_consensus({}, kLevel, kFocal, {}).status, PoseStatus::kTooFew);
  SceneGenerator scene(25);
  std::vector<AffineCorrespondence> acs(40);
  for (auto& ac : acs) ac = {scene.image_point(), scene.image_point(), Eigen::Matrix2d::Identity()};
  ConsensusOptions strict;
  strict.min_inliers = 30;
  const RobustResult result = one_ac_consensus(acs, kLevel, kFocal, strict);
  EXPECT_EQ(result.status, PoseStatus::kTooFew);
  EXPECT_EQ(result.inliers.size(), acs.size());
}

TEST(OneAcConsensus, GivesTheSameBitsEachTime) {
  SceneGenerator scene(26);
  const auto acs = street(scene, scene.planar_motion());
  const RobustResult a = one_ac_consensus(acs, kLevel, kFocal, {});
  const RobustResult b = one_ac_consensus(acs, kLevel, kFocal, {});
  EXPECT_TRUE(a.pose.R == b.pose.R && a.pose.t == b.pose.t);
  EXPECT_EQ(a.inliers, b.inliers);
}

TEST(OneAcConsensus, SurvivesCorrespondencesThatAreNotFinite) {
  SceneGenerator scene(27);
  const RelativePose T = scene.planar_motion();
  auto acs = street(scene, T);
  acs[5].A(0, 0) = std::numeric_limits<double>::quiet_NaN();
  acs[7].x2.x() = std::numeric_limits<double>::infinity();
  acs[9].x1.y() = std::numeric_limits<double>::quiet_NaN();
  const RobustResult result = one_ac_consensus(acs, kLevel, kFocal, {});
  expect_close(result, T, 0);
  EXPECT_FALSE(result.inliers[7]);
  EXPECT_FALSE(result.inliers[9]);
}

TEST(OneAcConsensus, RecognisesATurnOnTheSpot) {
  SceneGenerator scene(30);
  const RelativePose T{yaw_rotation(std::cos(0.15), std::sin(0.15)), Eigen::Vector3d::Zero()};
  std::vector<AffineCorrespondence> acs;
  acs.reserve(150);
  for (int i = 0; i < 150; ++i) {
    acs.push_back(scene.with_noise(scene.on_plane(T, scene.any_plane()), 0.15 / kFocal, 0.01));
  }
  const RobustResult result = one_ac_consensus(acs, kLevel, kFocal, {});
  EXPECT_EQ(result.status, PoseStatus::kPureRotation);
  EXPECT_LT(rotation_error(result.pose.R, T.R), 0.02 * kDegree);
  EXPECT_GT(result.covariance(1, 1), 0.0);
}

TEST(OneAcConsensus, SaysWhenEverythingLiesOnOnePlaneAndTakesTheVehiclesMotion) {
  SceneGenerator scene(31);
  for (int trial = 0; trial < 10; ++trial) {
    const RelativePose T = scene.planar_motion();
    const Plane ground = scene.ground();
    std::vector<AffineCorrespondence> acs;
    acs.reserve(200);
    for (int i = 0; i < 200; ++i) {
      acs.push_back(scene.with_noise(scene.on_plane(T, ground), 0.1 / kFocal, 0.01));
    }
    const RobustResult result = one_ac_consensus(acs, kLevel, kFocal, {});
    EXPECT_EQ(result.status, PoseStatus::kOnePlane) << "trial " << trial;
    EXPECT_LT(rotation_error(result.pose.R, T.R), 0.5 * kDegree) << "trial " << trial;
    EXPECT_LT(direction_error(result.pose.t, T.t), 5.0 * kDegree) << "trial " << trial;
  }
}

TEST(OneAcConsensus, CoversRollAndPitchTogetherAmongOutliers) {
  SceneGenerator scene(32);
  for (int trial = 0; trial < 10; ++trial) {
    RelativePose T = scene.planar_motion();
    T.R = roll_rotation(scene.uniform(-1.5, 1.5) * kDegree) *
          pitch_rotation(scene.uniform(-2.5, 2.5) * kDegree) * T.R;
    expect_close(one_ac_consensus(street(scene, T, 50), kLevel, kFocal, {}), T, trial);
  }
}

/// Without affine noise, so that a first look is sure to find good hypotheses.
std::vector<AffineCorrespondence> clean_street(SceneGenerator& scene, const RelativePose& T,
                                               double step) {
  std::vector<AffineCorrespondence> acs;
  for (int i = 0; i < 300; ++i) {
    const Plane plane = i % 3 == 0 ? scene.ground() : scene.any_plane();
    acs.push_back(scene.with_noise(scene.on_plane({T.R, step * T.t}, plane), 0.3 / kFocal, 0.01));
  }
  return acs;
}

TEST(OneAcConsensus, IsContentWithAFirstLookWhereItExplainsThePoints) {
  SceneGenerator scene(34);
  const RelativePose T = scene.planar_motion();
  const auto acs = clean_street(scene, T, 1.0);
  const RobustResult quick = one_ac_consensus(acs, kLevel, kFocal, {});
  expect_close(quick, T, 0);
  EXPECT_LE(quick.statistics.local_optimisations,
            static_cast<std::size_t>(ConsensusOptions{}.first_modes));
  ConsensusOptions thorough;
  thorough.first_modes = 0;
  const RobustResult slow = one_ac_consensus(acs, kLevel, kFocal, thorough);
  EXPECT_GT(slow.statistics.hypotheses, 4 * quick.statistics.hypotheses);
  EXPECT_LT(rotation_error(slow.pose.R, quick.pose.R), 1e-5);
  EXPECT_LT(direction_error(slow.pose.t, quick.pose.t), 1e-4);
}

TEST(OneAcConsensus, LooksAtEverythingWhereThePointsHardlyMoveBesideTheRotation) {
  SceneGenerator scene(35);
  RelativePose T = scene.planar_motion();
  T.t.normalize();
  // One pixel at the usual depths: any direction of travel leaves the points within the bound.
  const RobustResult result = one_ac_consensus(clean_street(scene, T, 0.01), kLevel, kFocal, {});
  EXPECT_GT(result.statistics.local_optimisations,
            static_cast<std::size_t>(ConsensusOptions{}.first_modes));
}

TEST(OneAcConsensus, LooksAtEverythingWhereManyCorrespondencesAreWrong) {
  SceneGenerator scene(36);
  const RelativePose T = scene.planar_motion();
  const RobustResult result = one_ac_consensus(street(scene, T, 60), kLevel, kFocal, {});
  expect_close(result, T, 0);
  EXPECT_GT(result.statistics.local_optimisations,
            static_cast<std::size_t>(ConsensusOptions{}.first_modes));
}

TEST(OneAcConsensus, CovarianceMatchesTheScatterOfItsErrors) {
  SceneGenerator scene(33);
  RelativePose T = scene.planar_motion();
  T.t.normalize();
  double squared = 0.0;
  constexpr int kTrials = 100;
  for (int trial = 0; trial < kTrials; ++trial) {
    const RobustResult result = one_ac_consensus(street(scene, T, 10), kLevel, kFocal, {});
    ASSERT_EQ(result.status, PoseStatus::kOk);
    EXPECT_NEAR((result.covariance.bottomRightCorner<3, 3>() * result.pose.t).norm(), 0.0, 1e-12);
    const Eigen::Matrix3d dR = T.R * result.pose.R.transpose();
    const Eigen::Vector3d w =
        0.5 * Eigen::Vector3d(dR(2, 1) - dR(1, 2), dR(0, 2) - dR(2, 0), dR(1, 0) - dR(0, 1));
    const Eigen::Matrix3d R_covariance = result.covariance.topLeftCorner<3, 3>();
    squared += w.dot(R_covariance.inverse() * w) / 3.0;
  }
  // Mean squared normalised error: 1 for an honest covariance; outliers near the lines add a bit.
  EXPECT_GT(squared / kTrials, 0.4);
  EXPECT_LT(squared / kTrials, 2.5);
}

TEST(ConsensusOptions, NameFieldValueAndBound) {
  ConsensusOptions options;
  options.threshold_px = -2.0;
  try {
    options.validate();
    FAIL() << "must throw";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("consensus.threshold_px = -2"), std::string::npos);
  }
}

TEST(PitchSweep, GoesOutFromZeroBothWays) {
  const std::vector<double> expected{0.0, 0.3, -0.3, 0.6, -0.6};
  const std::vector<double> pitches = pitch_sweep(0.6, 0.3);
  ASSERT_EQ(pitches.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_DOUBLE_EQ(pitches[i], expected[i]);
  EXPECT_EQ(pitch_sweep(0.0, 0.3).size(), 1U);
}

}  // namespace
}  // namespace oneac
