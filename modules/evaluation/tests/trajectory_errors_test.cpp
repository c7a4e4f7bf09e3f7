#include "oneac/evaluation/trajectory_errors.h"

#include "evaluation_test_tools.h"

#include <cmath>
#include <stdexcept>

namespace oneac {
namespace {

constexpr double kDegree = 0.017453292519943295;

/// x → scale R x + t on positions, R on orientations.
std::vector<Eigen::Isometry3d> moved(std::vector<Eigen::Isometry3d> poses, const Similarity& S) {
  for (Eigen::Isometry3d& T : poses) {
    T.translation() = S * Eigen::Vector3d(T.translation());
    T.linear() = S.R * T.linear();
  }
  return poses;
}

Similarity some_similarity(double scale) {
  return {scale, rotation_from_vector({0.4, -1.2, 0.7}), {10, -20, 30}};
}

TEST(AlignmentName, NamesRoundTripAndOthersAreRefused) {
  for (const char* name : {"none", "se3", "sim3"}) {
    EXPECT_EQ(name_of(alignment_from_name(name)), name);
  }
  EXPECT_THROW((void)alignment_from_name("Sim3"), std::invalid_argument);
}

TEST(TrajectoryErrors, Sim3RecoversScaleAndPose) {
  const auto truth = winding_drive(120, 3);
  const Similarity S = some_similarity(2.5);
  const auto errors = trajectory_errors({moved(truth, S), truth}, Alignment::kSim3);
  EXPECT_NEAR(errors.aligned_scale, 1.0 / 2.5, 1e-9);
  EXPECT_NEAR(errors.ape.max, 0.0, 1e-9);
  EXPECT_NEAR(errors.scale_error.value(), 1.5, 1e-9);
}

TEST(TrajectoryErrors, Se3RecoversThePoseButNotTheScale) {
  const auto truth = winding_drive(120, 3);
  EXPECT_NEAR(
      trajectory_errors({moved(truth, some_similarity(1.0)), truth}, Alignment::kSe3).ape.max, 0.0,
      1e-9);
  const auto scaled =
      trajectory_errors({moved(truth, some_similarity(2.0)), truth}, Alignment::kSe3);
  EXPECT_GT(scaled.ape.rmse, 1.0);
  EXPECT_EQ(scaled.aligned_scale, 1.0);
}

TEST(TrajectoryErrors, NoAlignmentComparesRawPositions) {
  const auto truth = straight_drive(3, 1.0);
  auto estimate = truth;
  estimate[1].translation().x() += 3.0;
  estimate[2].translation().y() += 4.0;
  const auto errors = trajectory_errors({estimate, truth}, Alignment::kNone);
  EXPECT_DOUBLE_EQ(errors.ape.max, 4.0);
  EXPECT_DOUBLE_EQ(errors.ape.median, 3.0);
  EXPECT_DOUBLE_EQ(errors.ape.mean, 7.0 / 3.0);
  EXPECT_DOUBLE_EQ(errors.ape.rmse, std::sqrt(25.0 / 3.0));
}

TEST(TrajectoryErrors, AlignmentNeverMirrors) {
  auto truth = winding_drive(60, 9);
  auto mirrored = truth;
  for (auto& T : mirrored) T.translation().x() = -T.translation().x();
  for (Alignment alignment : {Alignment::kSe3, Alignment::kSim3}) {
    EXPECT_GT(trajectory_errors({mirrored, truth}, alignment).ape.rmse, 0.1);
  }
}

TEST(TrajectoryErrors, AStandingTrajectoryStaysFinite) {
  const std::vector<Eigen::Isometry3d> standing(5, pose_at(1, 2, 3));
  for (Alignment alignment : {Alignment::kSe3, Alignment::kSim3}) {
    const auto errors = trajectory_errors({standing, standing}, alignment);
    EXPECT_NEAR(errors.ape.max, 0.0, 1e-12);
    EXPECT_EQ(errors.aligned_scale, 1.0);
    EXPECT_FALSE(errors.scale_error);
    EXPECT_FALSE(errors.subsequences);
  }
  EXPECT_NEAR(trajectory_errors({standing, straight_drive(5, 1)}, Alignment::kSim3).ape.rmse,
              std::sqrt(2.0), 1e-9);  // −2 … 2 around the mean
}

TEST(TrajectoryErrors, ASinglePoseHasNoRelativeErrors) {
  const auto errors = trajectory_errors({{pose_at(0, 0, 0)}, {pose_at(0, 0, 5)}}, Alignment::kSe3);
  EXPECT_EQ(errors.frames, 1U);
  EXPECT_FALSE(errors.rpe_translation);
  EXPECT_FALSE(errors.rpe_rotation);
}

TEST(TrajectoryErrors, RelativeErrorsAreOfConsecutiveFrames) {
  const auto truth = straight_drive(3, 1.0);
  // First step 1.5 m instead of 1 m, second exact but for a turn of 2° at its end.
  const std::vector<Eigen::Isometry3d> estimate{pose_at(0, 0, 0), pose_at(0, 0, 1.5),
                                                pose_at(0, 0, 2.5, 2 * kDegree)};
  const auto errors = trajectory_errors({estimate, truth}, Alignment::kNone);
  EXPECT_NEAR(errors.rpe_translation->max, 0.5, 1e-12);
  EXPECT_NEAR(errors.rpe_translation->mean, 0.25, 1e-12);
  EXPECT_NEAR(errors.rpe_rotation->max, 2 * kDegree, 1e-12);
  EXPECT_NEAR(errors.rpe_rotation->mean, 1 * kDegree, 1e-12);
  EXPECT_NEAR(errors.scale_error.value(), 0.25, 1e-12);
  EXPECT_NEAR(errors.length, 2.0, 1e-12);
}

TEST(TrajectoryErrors, SizesThatDifferAreMisuse) {
  EXPECT_THROW((void)trajectory_errors({straight_drive(2, 1), straight_drive(3, 1)}, {}),
               std::invalid_argument);
  EXPECT_THROW((void)trajectory_errors({}, {}), std::invalid_argument);
}

TEST(SubsequenceErrors, OfAScaledStraightDriveAreItsScale) {
  const auto errors = subsequence_errors({straight_drive(300, 1.1), straight_drive(300, 1.0)});
  ASSERT_TRUE(errors);
  EXPECT_NEAR(errors->translation, 0.1, 1e-12);
  EXPECT_NEAR(errors->rotation, 0.0, 1e-9);
}

TEST(SubsequenceErrors, StartEveryFifthFrameForEachLength) {
  // 299 m: lengths 100 and 200; starts 0, 5 … 195 and 0, 5 … 95.
  EXPECT_EQ(subsequence_errors({straight_drive(300, 1), straight_drive(300, 1)})->count, 60U);
}

TEST(SubsequenceErrors, OfAShortDriveUseShortLengths) {
  // 50 m: lengths 20 and 40; starts 0, 5 … 30 and 0, 5, 10.
  EXPECT_EQ(subsequence_errors({straight_drive(51, 1), straight_drive(51, 1)})->count, 10U);
  EXPECT_FALSE(subsequence_errors({straight_drive(21, 1), straight_drive(21, 1)}));
}

TEST(SubsequenceErrors, OfASteadyDriftAreDegreesPerLength) {
  const auto truth = straight_drive(300, 1.0);
  std::vector<Eigen::Isometry3d> estimate{truth.front()};
  const Eigen::Isometry3d step = pose_at(0, 0, 1, 0.01 * kDegree);
  while (estimate.size() < truth.size()) estimate.push_back(estimate.back() * step);
  const auto errors = subsequence_errors({estimate, truth});
  EXPECT_NEAR(errors->rotation, 0.01 * kDegree, 1e-12);  // per metre
}

TEST(SubsequenceErrors, DoNotDependOnWhereTheEstimateStarts) {
  const auto truth = winding_drive(200, 4);
  const auto errors = subsequence_errors({moved(truth, some_similarity(1.0)), truth});
  EXPECT_NEAR(errors->translation, 0.0, 1e-9);
  EXPECT_NEAR(errors->rotation, 0.0, 1e-9);
}

TEST(PathLength, SumsTheSteps) {
  EXPECT_DOUBLE_EQ(path_length({pose_at(0, 0, 0), pose_at(3, 4, 0), pose_at(3, 4, 2)}), 7.0);
}

}  // namespace
}  // namespace oneac
