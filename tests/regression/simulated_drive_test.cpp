#include "oneac/evaluation/evaluate.h"
#include "oneac/evaluation/relative_poses_io.h"
#include "oneac/evaluation/trajectory_io.h"
#include "oneac/test_support/program.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oneac {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

std::string read_text(const std::string& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The demo's drive: `oneac simulate`, then `oneac run`, both with their defaults.
class SimulatedDrive : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    const std::string drive = (folder_->path() / "drive").string();
    ASSERT_EQ(run_program({ONEAC_PROGRAM, "simulate", "-o", drive}).exit_code, 0);
    evaluation_ = evaluation_with({});
    rows_ = read_relative_poses((folder_->path() / "out/relative_poses.csv").string());
  }
  static void TearDownTestSuite() { folder_.reset(); }

  /// Runs the drive with these settings.
  static Evaluation evaluation_with(const std::vector<std::string>& settings) {
    const std::string drive = (folder_->path() / "drive").string();
    const std::string out = (folder_->path() / "out").string();
    std::vector<std::string> words = {ONEAC_PROGRAM, "run", drive + "/simulated.rawlog", "-o", out};
    for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
    const ProgramResult run = run_program(words);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return evaluate_run(read_relative_poses(out + "/relative_poses.csv"),
                        read_kitti(out + "/trajectory_camera.kitti"),
                        read_kitti(drive + "/poses.txt"));
  }

  static std::unique_ptr<TemporaryFolder> folder_;
  static std::vector<RelativePoseRow> rows_;
  static Evaluation evaluation_;
};

std::unique_ptr<TemporaryFolder> SimulatedDrive::folder_;
std::vector<RelativePoseRow> SimulatedDrive::rows_;
Evaluation SimulatedDrive::evaluation_;

TEST_F(SimulatedDrive, PairsAreAccurateAndNoneLiesInAWrongBasin) {
  const PairSummary& summary = *evaluation_.pair_summary;
  EXPECT_LE(summary.rotation->median, 0.005 * kDegree);
  EXPECT_LE(summary.rotation->mean, 0.01 * kDegree);
  EXPECT_LE(summary.direction->median, 0.04 * kDegree);
  EXPECT_EQ(summary.bad, 0U);
}

TEST_F(SimulatedDrive, MostMovingPairsAreInMetres) {
  const PairSummary& summary = *evaluation_.pair_summary;
  EXPECT_GE(static_cast<double>(summary.metric), 0.8 * static_cast<double>(summary.moving));
  EXPECT_LE(summary.length->median, 0.01);
}

TEST_F(SimulatedDrive, TheStopIsAStop) {
  std::size_t standing = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (evaluation_.pairs[i].true_step > 0.002)
      continue;  // rocking on the springs moves millimetres
    ++standing;
    EXPECT_EQ(rows_[i].status, "no_motion") << "pair " << rows_[i].index1;
    EXPECT_EQ(rows_[i].T_2_1.t.norm(), 0.0);
  }
  EXPECT_GE(standing, 20U);
}

/// [deg] pitch against the path of a second on each side; empty where the car hardly moved.
std::optional<double> pitch_on_path(const std::vector<Eigen::Isometry3d>& poses, std::size_t i) {
  constexpr std::size_t kSecond = 10;
  if (i < kSecond || i + kSecond >= poses.size()) return std::nullopt;
  const Eigen::Vector3d way = poses[i + kSecond].translation() - poses[i - kSecond].translation();
  if (way.norm() < 2.0) return std::nullopt;
  const Eigen::Vector3d along = poses[i].linear().transpose() * way;
  return std::atan2(along.y(), std::hypot(along.x(), along.z())) / kDegree;
}

TEST_F(SimulatedDrive, TellsThePitchOfTheSprings) {
  const std::string folder = folder_->path().string();
  const auto truth = read_kitti(folder + "/drive/poses.txt").poses;
  std::ifstream file(folder + "/out/tilt.csv");
  std::string line;
  std::getline(file, line);
  double squares = 0.0, squares_of_slow = 0.0;
  std::size_t frames = 0;
  for (std::size_t i = 0; std::getline(file, line); ++i) {
    double slow = 0.0, springs = 0.0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%*u,%*f,%lf,%*f,%*f,%*f,%lf", &slow, &springs), 2) << line;
    const auto pitch = pitch_on_path(truth, i);
    if (!pitch) continue;
    squares += std::pow(slow + springs - *pitch, 2);
    squares_of_slow += std::pow(slow - *pitch, 2);
    ++frames;
  }
  ASSERT_GT(frames, 100U);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(frames)), 0.15);
  EXPECT_LT(squares, 0.4 * squares_of_slow);
}

TEST_F(SimulatedDrive, TheTrajectoryStaysOnTheRoad) {
  ASSERT_TRUE(evaluation_.trajectory.has_value());
  EXPECT_LE(std::abs(*evaluation_.trajectory->scale_error), 0.01);
  EXPECT_LE(evaluation_.trajectory->ape.rmse, 0.002 * evaluation_.trajectory->length);
}

/// Everything that hurts at once: a ten-second stop, right-angled bends, a 3 % slope, traffic that
/// crosses, a dark stretch while driving.
/// With the road's points where their affinities put them, pairs and window hold their direction.
TEST_F(SimulatedDrive, AffinitiesKeepItFromTurningAway) {
  const Evaluation points_alone = evaluation_with({"front_end.perspective=false"});
  ASSERT_TRUE(evaluation_.trajectory && points_alone.trajectory);
  const TrajectoryErrors& both = *evaluation_.trajectory;
  ASSERT_TRUE(both.subsequences && points_alone.trajectory->subsequences);
  EXPECT_LE(both.subsequences->rotation, 0.6 * points_alone.trajectory->subsequences->rotation);
  EXPECT_LE(evaluation_.pair_summary->direction->mean,
            0.7 * points_alone.pair_summary->direction->mean);
}

TEST(HardDrive, IsNeverLostAndKeepsItsMetres) {
  const TemporaryFolder folder;
  const std::string drive = (folder.path() / "drive").string();
  const std::string out = (folder.path() / "out").string();
  ASSERT_EQ(run_program({ONEAC_PROGRAM, "simulate", "-o", drive, "--frames", "360", "--stop", "10",
                         "--slope", "3", "--crossing-traffic", "--dark-from", "4", "--dark", "1"})
                .exit_code,
            0);
  const ProgramResult run =
      run_program({ONEAC_PROGRAM, "run", drive + "/simulated.rawlog", "-o", out});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto rows = read_relative_poses(out + "/relative_poses.csv");
  const Trajectory estimate = read_kitti(out + "/trajectory_camera.kitti");
  const Evaluation evaluation = evaluate_run(rows, estimate, read_kitti(drive + "/poses.txt"));
  EXPECT_EQ(estimate.poses.size(), 360U);
  ASSERT_TRUE(evaluation.trajectory.has_value());
  EXPECT_LE(std::abs(*evaluation.trajectory->scale_error), 0.02);
  EXPECT_LE(evaluation.trajectory->ape.rmse, 0.02 * evaluation.trajectory->length);
  double moved_while_standing = 0.0;
  int standing = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].status == "ok") {
      EXPECT_FALSE(evaluation.pairs[i].is_bad()) << "pair " << rows[i].index1;
    }
    if (evaluation.pairs[i].true_step > 1e-4 || rows[i].status == "predicted") continue;
    ++standing;
    moved_while_standing += rows[i].T_2_1.t.norm();
  }
  EXPECT_GE(standing, 60);
  EXPECT_LT(moved_while_standing, 0.02);
}

/// Metres by the baseline alone: the camera's height is not in the log.
TEST(StereoDrive, IsInMetresByItsBaseline) {
  const TemporaryFolder folder;
  const std::string drive = (folder.path() / "drive").string();
  const std::string log = drive + "/simulated.rawlog", out = (folder.path() / "out").string();
  ASSERT_EQ(run_program({ONEAC_PROGRAM, "simulate", "-o", drive, "--frames", "120", "--stereo",
                         "--camera-height", "1.2"})
                .exit_code,
            0);
  const ProgramResult run = run_program({ONEAC_PROGRAM, "run", log, "-o", out, "--camera", "left",
                                         "--set", "front_end.scale.source=stereo"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto summary = nlohmann::json::parse(read_text(out + "/summary.json"));
  EXPECT_EQ(summary["camera_height_m"].get<double>(), 0.0) << "the road took part";
  const Evaluation evaluation =
      evaluate_run(read_relative_poses(out + "/relative_poses.csv"),
                   read_kitti(out + "/trajectory_camera.kitti"), read_kitti(drive + "/poses.txt"));
  const PairSummary& pairs = *evaluation.pair_summary;
  EXPECT_GE(static_cast<double>(pairs.metric), 0.95 * static_cast<double>(pairs.moving));
  EXPECT_LE(pairs.length->median, 0.03);
  EXPECT_LE(std::abs(*evaluation.trajectory->scale_error), 0.02);

  const ProgramResult wrong = run_program({ONEAC_PROGRAM, "run", log, "-o", out, "--camera",
                                           "right", "--set", "front_end.scale.source=stereo"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("not the left one of a stereo pair"), std::string::npos) << wrong.err;
}

}  // namespace
}  // namespace oneac
