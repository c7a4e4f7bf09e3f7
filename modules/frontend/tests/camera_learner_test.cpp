#include "camera/camera_learner.h"

#include "camera/focal_doubt.h"

#include "oneac/test_support/synthetic_bend.h"

#include <gtest/gtest.h>

#include <cstddef>

namespace oneac {
namespace {

CameraLearner learning(const char* refine) {
  SelfCalibrationOptions options;
  options.refine = refine;
  return CameraLearner(options);
}

/// What the front-end makes of a place in an undistorted image, as far as it has learned.
Eigen::Vector2d normalised_by(const CameraLearner& learner, const Eigen::Vector2d& undistorted) {
  TrackedPair pair;
  pair.correspondences.emplace_back();
  pair.correspondences[0].x2 =
      learner.used().normalise(learner.belief().given.project(undistorted));
  const auto lens = learner.lens();
  return lens ? lens->corrected(pair).correspondences[0].x2 : pair.correspondences[0].x2;
}

/// Three windows, as this camera sees them.
/// @param given  of the images as they are stored: undistorted ones are true_camera()'s
void drive_with(CameraLearner& learner, double turn, const PinholeCamera& truth,
                const PinholeCamera& given = true_camera()) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SyntheticDrive drive;
    drive.turn = turn;
    drive.noise_px = 0.1;
    drive.seed = seed;
    std::size_t index = 0;
    for (const CalibrationView& view : synthetic_window(drive, truth).views) {
      NewestKeyframe keyframe{view.T_view_map, {}};
      for (const CalibrationSighting& seen : view.sightings) {
        // Tracks of one bend end before the next.
        keyframe.sightings.push_back({1000U * seed + seen.track,
                                      normalised_by(learner, normalise_distorted(given, seen.u))});
      }
      learner.follow(keyframe, index, 0.1 * static_cast<double>(index));
      ++index;
    }
  }
  learner.finish();
}

/// As a camera of another focal length sees them that is given as true_camera().
void drive_on(CameraLearner& learner, double turn, double true_focal_factor) {
  PinholeCamera truth = true_camera();
  truth.fx *= true_focal_factor;
  truth.fy *= true_focal_factor;
  drive_with(learner, turn, truth);
}

TEST(CameraLearner, AccusesAFocalLengthThatIsTenPercentOffAndNamesTheOther) {
  CameraLearner learner({});
  learner.start(true_camera());
  EXPECT_FALSE(learner.fault());
  drive_on(learner, 0.03, 1.0 / 1.1);
  ASSERT_TRUE(learner.fault());
  EXPECT_NEAR(learner.belief().focal_px, 720.0 / 1.1, 720.0 * 0.01);
  EXPECT_NE(learner.fault()->find("oneac calibrate"), std::string::npos);
  EXPECT_EQ(learner.used().fx, true_camera().fx);  // off: nothing moves
}

TEST(CameraLearner, LeavesAFocalLengthInPeaceThatIsRightOrThatNobodyCanKnow) {
  CameraLearner right({});
  right.start(true_camera());
  drive_on(right, 0.03, 1.0);
  EXPECT_FALSE(right.fault());
  EXPECT_EQ(right.belief().bends, 3U);
  CameraLearner straight({});
  straight.start(true_camera());
  drive_on(straight, 0.0, 1.0 / 1.1);
  EXPECT_FALSE(straight.fault());
  EXPECT_EQ(straight.belief().bends, 0U);
  EXPECT_FALSE(straight.belief().knows_focal());
  EXPECT_EQ(straight.belief().focal_sigma, SelfCalibrationOptions{}.focal_sigma);
}

TEST(FocalDoubt, RisesWithWhatContradictsAndVanishesWhereItIsConfirmed) {
  EXPECT_LT(focal_doubt(0.0, 0.01), 0.002);
  EXPECT_LT(focal_doubt(0.01, 0.01), 0.003);
  EXPECT_NEAR(focal_doubt(0.05, 0.022), 0.023, 0.003) << "2 sigma: as likely poor as good";
  EXPECT_NEAR(focal_doubt(0.08, 0.02), 0.072, 0.003) << "surely poor: all of it";
  double before = 0.0;
  for (double off = 0.0; off < 0.3; off += 0.005) {
    const double doubt = focal_doubt(off, 0.02);
    EXPECT_GE(doubt, before);
    EXPECT_EQ(doubt, focal_doubt(-off, 0.02));
    before = doubt;
  }
}

TEST(FocalDoubt, AnAnswerThatIsNoneIsNoDoubt) {
  EXPECT_EQ(focal_doubt(std::nan(""), 0.01), 0.0);
  EXPECT_EQ(focal_doubt(0.1, 0.0), 0.0);
  EXPECT_EQ(focal_doubt(0.1, INFINITY), 0.0);
  EXPECT_TRUE(std::isfinite(focal_doubt(10.0, 1e-6)));
}

TEST(CameraLearner, DoubtsAFocalLengthBeforeItAccusesIt) {
  CameraLearner right({}), wrong({});
  right.start(true_camera());
  drive_on(right, 0.03, 1.0);
  EXPECT_LT(right.belief().doubt, 0.005);
  wrong.start(true_camera());
  drive_on(wrong, 0.03, 1.025);
  EXPECT_FALSE(wrong.fault());
  EXPECT_NEAR(wrong.belief().doubt, 0.025, 0.01);
}

TEST(CameraLearner, UsesWhatItLearnedWhenAskedTo) {
  CameraLearner learner = learning("focal");
  learner.start(true_camera());
  drive_on(learner, 0.03, 1.03);
  EXPECT_NEAR(learner.used().fx, 720.0 * 1.03, 720.0 * 0.01);
  EXPECT_EQ(learner.used().cx, true_camera().cx);
  EXPECT_FALSE(learner.fault());
  EXPECT_GE(learner.belief().history.size(), 3U);
}

TEST(CameraLearner, LearnsALensWhenAskedToOfRawImages) {
  PinholeCamera given = true_camera(), truth = true_camera();
  given.distortion = {-0.3, 0.1, 1e-3, -5e-4, 0.0};
  truth.distortion = {-0.2, 0.05, 1e-3, -5e-4, 0.0};
  truth.fx = truth.fy = 1.02 * truth.fx;
  truth.cx += 8.0;
  CameraLearner learner = learning("full");
  learner.start(true_camera(), given);
  drive_with(learner, 0.03, truth, given);
  drive_with(learner, 0.03, truth, given);  // its keyframes are normalised by what was learned
  ASSERT_TRUE(learner.lens().has_value());
  const PinholeCamera& learned = learner.belief().raw_learned;
  EXPECT_NEAR(learned.fx, truth.fx, 0.005 * truth.fx);
  EXPECT_NEAR(learned.cx, truth.cx, 2.0);
  EXPECT_NEAR(learned.distortion[0], -0.2, 0.02);
  EXPECT_EQ(learned.distortion[2], 1e-3) << "is not learned";
  const Eigen::Vector2d direction(0.6, 0.2), u = project_distorted(truth, direction);
  const Eigen::Vector2d before = normalise_distorted(given, u);
  EXPECT_LT((normalised_by(learner, before) - direction).norm(), 0.1 * (before - direction).norm());
  EXPECT_LT(learner.belief().sigma[kK1], 0.02);
}

TEST(CameraLearner, LooksAtUndistortedImagesWhereALongerFocalLengthIsNoOtherLens) {
  PinholeCamera fisheye = true_camera(), truth = true_camera();
  fisheye.lens = LensModel::kannala_brandt;
  truth.distortion[0] = 0.06;
  CameraLearner learner = learning("focal");
  learner.start(true_camera(), fisheye);
  drive_with(learner, 0.03, truth);
  EXPECT_FALSE(learner.belief().knows_raw);
  EXPECT_EQ(learner.belief().raw_learned.lens, LensModel::plumb_bob);
  EXPECT_NEAR(learner.belief().raw_learned.distortion[0], 0.06, 0.02);
}

TEST(CameraLearner, LearnsAFisheyeOfRawImages) {
  PinholeCamera given = true_camera();
  given.lens = LensModel::kannala_brandt;
  PinholeCamera truth = given;
  truth.distortion[0] = -0.06;
  truth.cx += 8.0;
  CameraLearner learner = learning("full");
  learner.start(true_camera(), given);
  for (int i = 0; i < 2; ++i) drive_with(learner, 0.03, truth, given);
  ASSERT_TRUE(learner.lens().has_value());
  EXPECT_TRUE(learner.belief().knows_raw);
  EXPECT_EQ(learner.belief().raw_used.lens, LensModel::kannala_brandt);
  EXPECT_NEAR(learner.belief().raw_used.distortion[0], -0.06, 0.02);
  EXPECT_NEAR(learner.belief().raw_used.cx, truth.cx, 2.0);
}

TEST(CameraLearner, KeepsALensThatBendsDoNotContradict) {
  CameraLearner learner = learning("full");
  learner.start(true_camera());
  drive_on(learner, 0.03, 1.0);
  drive_on(learner, 0.03, 1.0);
  EXPECT_NE(learner.belief().raw_learned.cx, true_camera().cx);
  EXPECT_EQ(learner.used().cx, true_camera().cx);
  EXPECT_FALSE(learner.lens().has_value());
}

TEST(CameraLearner, KeepsAGivenFocalLengthThatBendsDoNotContradict) {
  CameraLearner learner = learning("focal");
  learner.start(true_camera());
  drive_on(learner, 0.03, 1.0);
  EXPECT_NE(learner.belief().focal_px, true_camera().fx);
  EXPECT_EQ(learner.used().fx, true_camera().fx);
}

TEST(CameraLearner, LooksAtNothingWhenSwitchedOff) {
  SelfCalibrationOptions options;
  options.check = false;
  CameraLearner learner(options);
  learner.start(true_camera());
  drive_on(learner, 0.03, 1.0 / 1.1);
  EXPECT_EQ(learner.belief().bends, 0U);
  EXPECT_FALSE(learner.fault());
}

}  // namespace
}  // namespace oneac
