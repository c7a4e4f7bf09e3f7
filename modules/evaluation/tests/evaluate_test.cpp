#include "oneac/evaluation/evaluate.h"

#include "evaluation_test_tools.h"

#include "oneac/evaluation/covariance_io.h"
#include "oneac/test_support/temporary_folder.h"

#include <cmath>
#include <stdexcept>

namespace oneac {
namespace {

constexpr double kStart = 1229456789.0;
constexpr double kPeriod = 0.05;

double time_of(std::size_t index) {
  return kStart + kPeriod * static_cast<double>(index);
}

/// A run over a log of 60 images that processes every third from image 6 on, without error.
class EvaluatedRun : public ::testing::Test {
 protected:
  EvaluatedRun() {
    reference_.poses = winding_drive(60, 21);
    for (std::size_t k = 6; k < 60; k += 3) indices_.push_back(k);
    for (std::size_t index : indices_) {
      estimate_.poses.push_back(reference_.poses[6].inverse() * reference_.poses[index]);
    }
    for (std::size_t k = 1; k < indices_.size(); ++k) rows_.push_back(row(k));
  }
  RelativePoseRow row(std::size_t k) const {
    const Eigen::Isometry3d T = estimate_.poses[k].inverse() * estimate_.poses[k - 1];
    RelativePoseRow r;
    r.index1 = indices_[k - 1];
    r.index2 = indices_[k];
    r.t1 = time_of(r.index1);
    r.t2 = time_of(r.index2);
    r.T_2_1 = {T.linear(), T.translation()};
    r.metric = true;
    r.status = "ok";
    return r;
  }
  void give_times() {
    for (std::size_t k = 0; k < 60; ++k) reference_.times.push_back(time_of(k) + 0.001);
    for (std::size_t index : indices_) estimate_.times.push_back(time_of(index));
  }
  std::filesystem::path file(const std::string& name, const std::string& text) {
    return write_text(folder_.path() / name, text);
  }
  static void expect_exact(const Evaluation& evaluation) {
    ASSERT_TRUE(evaluation.trajectory);
    EXPECT_EQ(evaluation.trajectory->frames, 18U);
    EXPECT_EQ(evaluation.estimate_frames, 18U);
    EXPECT_EQ(evaluation.reference_frames, 60U);
    EXPECT_NEAR(evaluation.trajectory->ape.max, 0.0, 1e-9);
    EXPECT_NEAR(evaluation.trajectory->rpe_rotation->max, 0.0, 1e-9);
  }

  Trajectory reference_;
  Trajectory estimate_;
  std::vector<std::size_t> indices_;
  std::vector<RelativePoseRow> rows_;
  TemporaryFolder folder_;
};

TEST_F(EvaluatedRun, PairsAreComparedWithTheRowsTheirIndicesName) {
  const Evaluation evaluation = evaluate_pairs(rows_, reference_);
  EXPECT_EQ(evaluation.pair_summary->pairs, 17U);
  EXPECT_EQ(evaluation.pair_summary->metric, 17U);
  EXPECT_NEAR(evaluation.pair_summary->rotation->max, 0.0, 1e-9);
  EXPECT_NEAR(evaluation.pair_summary->direction->max, 0.0, 1e-9);
  EXPECT_NEAR(evaluation.pair_summary->length->max, 0.0, 1e-9);
}

TEST_F(EvaluatedRun, PairsAreComparedByTimeWhereTheReferenceHasTimes) {
  give_times();
  for (RelativePoseRow& r : rows_) r.index1 = r.index2 = 0;  // only the times can tell
  const Evaluation evaluation = evaluate_pairs(rows_, reference_);
  EXPECT_EQ(evaluation.pair_summary->pairs, 17U);
  EXPECT_NEAR(evaluation.pair_summary->rotation->max, 0.0, 1e-9);
}

TEST_F(EvaluatedRun, PairsWithoutAReferenceAreCounted) {
  reference_.poses.resize(30);  // images 0 … 29: pairs up to (24, 27)
  const Evaluation evaluation = evaluate_pairs(rows_, reference_);
  EXPECT_EQ(evaluation.pair_summary->pairs, 7U);
  EXPECT_EQ(evaluation.pair_summary->without_reference, 10U);
}

TEST_F(EvaluatedRun, RunIsAssociatedByIndexOrTime) {
  expect_exact(evaluate_run(rows_, estimate_, reference_));
  give_times();
  expect_exact(evaluate_run(rows_, estimate_, reference_));
}

TEST_F(EvaluatedRun, RunOfOneFrameHasNothingToSay) {
  estimate_.poses.resize(1);
  const Evaluation evaluation = evaluate_run({}, estimate_, reference_);
  EXPECT_FALSE(evaluation.trajectory);
  EXPECT_EQ(evaluation.pair_summary->pairs, 0U);
}

TEST_F(EvaluatedRun, RunAndForeignReferenceHaveNothingInCommon) {
  give_times();
  for (double& time : reference_.times) time += 1000.0;
  const Evaluation evaluation = evaluate_run(rows_, estimate_, reference_);
  EXPECT_FALSE(evaluation.trajectory);
  EXPECT_EQ(evaluation.pair_summary->without_reference, 17U);
}

TEST_F(EvaluatedRun, RowsThatDoNotFitTheTrajectoryAreMisuse) {
  estimate_.poses.pop_back();
  EXPECT_THROW((void)evaluate_run(rows_, estimate_, reference_), std::invalid_argument);
}

TEST_F(EvaluatedRun, TrajectoryAloneIsAssociatedByTimeOrRow) {
  EXPECT_EQ(evaluate_trajectory(reference_, reference_).trajectory->frames, 60U);
  give_times();
  const Evaluation evaluation = evaluate_trajectory(estimate_, reference_);
  expect_exact(evaluation);
  EXPECT_FALSE(evaluation.pair_summary);
}

TEST_F(EvaluatedRun, TrajectoryAloneThatCannotBeAssociatedIsMisuse) {
  EXPECT_THROW((void)evaluate_trajectory(estimate_, reference_), std::invalid_argument);
  give_times();
  for (double& time : reference_.times) time += 1000.0;
  EXPECT_THROW((void)evaluate_trajectory(estimate_, reference_), std::invalid_argument);
  EXPECT_THROW((void)evaluate_trajectory({}, {}), std::invalid_argument);
}

TEST_F(EvaluatedRun, FilesOfPairsAreEvaluatedAsPairsAlways) {
  const auto csv = file("relative_poses.csv", format_relative_poses(rows_));
  const auto poses = file("poses.txt", format_kitti(reference_));
  const Evaluation evaluation = evaluate_files({csv, poses});
  EXPECT_EQ(evaluation.pair_summary->pairs, 17U);
  EXPECT_FALSE(evaluation.trajectory);
}

TEST_F(EvaluatedRun, ThinnedTrajectoryIsAssociatedByThePairsBesideIt) {
  file("relative_poses.csv", format_relative_poses(rows_));
  const auto estimate = file("trajectory_camera.kitti", format_kitti(estimate_));
  const auto poses = file("poses.txt", format_kitti(reference_));
  const Evaluation evaluation = evaluate_files({estimate, poses, Alignment::kSe3, true});
  expect_exact(evaluation);
  EXPECT_EQ(evaluation.pair_summary->pairs, 17U);
  EXPECT_EQ(evaluation.pairs.at(1).index1, 9U);
  EXPECT_EQ(evaluation.pairs.at(1).index2, 12U);
  EXPECT_NEAR(evaluation.pair_summary->length->max, 0.0, 1e-9);
}

TEST_F(EvaluatedRun, ThinnedTrajectoryMeetsATimedReferenceByThePairsTimes) {
  file("relative_poses.csv", format_relative_poses(rows_));
  const auto estimate = file("trajectory_camera.kitti", format_kitti(estimate_));
  give_times();
  expect_exact(evaluate_files({estimate, file("truth.tum", format_tum(reference_))}));
}

TEST_F(EvaluatedRun, AnOffsetMovesTheTimesOfPairsAndOfThoseBesideATrajectory) {
  constexpr double kOffset = 5.0;
  give_times();
  for (double& time : reference_.times) time += kOffset;
  EvaluationRequest request;
  request.reference = file("truth.tum", format_tum(reference_));
  request.time.offset_s = kOffset;
  file("relative_poses.csv", format_relative_poses(rows_));
  request.estimate = file("trajectory_camera.kitti", format_kitti(estimate_));
  expect_exact(evaluate_files(request));
  rows_.erase(rows_.begin() + 3);  // they are no chain any more
  request.estimate = file("relative_poses.csv", format_relative_poses(rows_));
  const Evaluation pairs = evaluate_files(request);
  EXPECT_EQ(pairs.pair_summary->pairs, 16U);
  EXPECT_EQ(pairs.offset_s, kOffset);
  EXPECT_TRUE(pairs.notes.empty());
}

TEST_F(EvaluatedRun, TumFilesAreAssociatedByTime) {
  give_times();
  const auto estimate = file("e.tum", format_tum(estimate_));
  const auto poses = file("truth.tum", format_tum(reference_));
  const Evaluation evaluation = evaluate_files({estimate, poses});
  expect_exact(evaluation);
  EXPECT_FALSE(evaluation.pair_summary);  // not asked for
}

TEST_F(EvaluatedRun, TakesTheTablesOfPosesForTrajectories) {
  give_times();
  std::vector<PoseCovarianceRow> rows(estimate_.poses.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].time_s = estimate_.times[i];
    rows[i].T_world_body = estimate_.poses[i];
  }
  const auto poses = file("truth.tum", format_tum(reference_));
  const auto table = file("trajectory_camera.csv", format_pose_covariances(rows));
  expect_exact(evaluate_files({table, poses}));
}

TEST_F(EvaluatedRun, EquallyLongTrajectoriesAreAssociatedRowByRow) {
  const auto estimate = file("e.kitti", format_kitti({{}, straight_drive(4, 1.5)}));
  const auto poses = file("poses.txt", format_kitti({{}, straight_drive(4, 1.0)}));
  const Evaluation evaluation = evaluate_files({estimate, poses, Alignment::kNone, true});
  EXPECT_NEAR(evaluation.trajectory->ape.max, 1.5, 1e-12);
  EXPECT_NEAR(evaluation.pair_summary->length->mean, 0.5, 1e-12);
}

TEST_F(EvaluatedRun, AnOffsetThatCountsForNothingOrLeadsAstrayIsSaid) {
  EvaluationRequest request;
  request.estimate = file("e.kitti", format_kitti({{}, straight_drive(4, 1.5)}));
  Trajectory timed{{1.0, 2.0, 3.0, 4.0}, straight_drive(4, 1.0)};
  request.reference = file("truth.tum", format_tum(timed));
  request.time.offset_s = 100.0;
  const Evaluation evaluation = evaluate_files(request);
  ASSERT_EQ(evaluation.notes.size(), 1U);
  expect_contains(evaluation.notes.front(), "the offset counts for nothing");
  EXPECT_FALSE(evaluation.offset_s.has_value());
  request.estimate = request.reference;
  const auto message = input_error_of([&] { (void)evaluate_files(request); });
  expect_contains(message, "(101.000 to 104.000 s, the offset of 100.000 s added, against 1.000");
  expect_contains(message, "correct --offset");
}

TEST_F(EvaluatedRun, SizesThatDifferWithoutPairsNameBothAndTheCure) {
  const auto estimate = file("e.kitti", format_kitti(estimate_));
  const auto poses = file("poses.txt", format_kitti(reference_));
  const auto message = input_error_of([&] { (void)evaluate_files({estimate, poses}); });
  expect_contains(message, "e.kitti: has 18 poses");
  expect_contains(message, "poses.txt has 60 poses");
  expect_contains(message, "relative_poses.csv");
}

TEST_F(EvaluatedRun, PairsOfAnotherRunAreRefused) {
  rows_.pop_back();
  file("relative_poses.csv", format_relative_poses(rows_));
  const auto estimate = file("e.kitti", format_kitti(estimate_));
  const auto poses = file("poses.txt", format_kitti(reference_));
  const auto message = input_error_of([&] { (void)evaluate_files({estimate, poses}); });
  expect_contains(message, "relative_poses.csv: does not connect the 18 poses of e.kitti");
}

TEST_F(EvaluatedRun, ForeignTimesAndIndicesNameBothFiles) {
  give_times();
  const auto estimate = file("e.tum", format_tum(estimate_));
  const auto csv = file("relative_poses.csv", format_relative_poses(rows_));
  for (double& time : reference_.times) time += 1000.0;
  const auto poses = file("truth.tum", format_tum(reference_));
  for (const auto& path : {estimate, csv}) {
    const auto message = input_error_of([&] { (void)evaluate_files({path, poses}); });
    expect_contains(message, path.filename().string() + ": has no frame in common with");
    expect_contains(message, "truth.tum");
  }
}

TEST_F(EvaluatedRun, MissingEstimateReferenceAndPairsAreNamed) {
  const auto poses = file("poses.txt", format_kitti(reference_));
  const auto none = folder_.path() / "none.kitti";
  expect_contains(input_error_of([&] { (void)evaluate_files({none, poses}); }), "none.kitti: no");
  expect_contains(input_error_of([&] { (void)evaluate_files({poses, none}); }), "none.kitti: no");
  const auto csv = file("relative_poses.csv", format_relative_poses({}));
  expect_contains(input_error_of([&] { (void)evaluate_files({csv, poses}); }), "has no pairs");
}

}  // namespace
}  // namespace oneac
