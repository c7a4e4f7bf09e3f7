#include "oneac/evaluation/evaluate.h"
#include "oneac/evaluation/relative_poses_io.h"
#include "oneac/evaluation/trajectory_io.h"
#include "oneac/test_support/program.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

/// The catalogue of docs/benchmarks/hard-drives.md: each drive comes out right, or is not in metres
/// and the run says why; never in metres and wrong.
namespace oneac {
namespace {

enum class Outcome {
  kRight,   ///< in metres, length within 3 %, no wrong direction
  kHonest,  ///< right, or what is called metric is right and a note says why the rest is not
};

struct Row {
  const char* name;
  std::vector<std::string> simulate;  ///< flags beside -o
  Outcome expected;
  std::vector<std::string> run = {};  ///< the same of `oneac run`
};

/// What the step has to reach.
const std::vector<Row>& rows() {
  static const std::vector<std::string> kHeight = {"--set", "front_end.camera_height=1.5"};
  static const std::vector<Row> kRows = {
      {"Bonnet", {"--hard", "bonnet"}, Outcome::kHonest},
      {"BonnetInTown", {"--frames", "60", "--bonnet", "0.25"}, Outcome::kRight},
      {"Rain", {"--hard", "rain"}, Outcome::kRight},
      {"RainOnADarkRoad", {"--hard", "rain", "--seed", "2", "--road", "dark"}, Outcome::kHonest},
      {"RainAtNight", {"--hard", "rain", "--seed", "2", "--night"}, Outcome::kHonest},
      {"ExposureJumps", {"--hard", "exposure"}, Outcome::kRight},
      {"Night", {"--hard", "night"}, Outcome::kHonest},
      {"VideoAtAnotherRate", {"--repeat-every", "5", "--frames", "120"}, Outcome::kHonest},
      {"EveryImageTwiceAtNight",
       {"--repeat-every", "2", "--night", "--frames", "160"},
       Outcome::kHonest},
      {"RollingShutter", {"--hard", "rolling-shutter"}, Outcome::kRight},
      {"FarScenery", {"--hard", "far"}, Outcome::kRight},
      {"DashesOnly", {"--hard", "dashes"}, Outcome::kRight},
      {"SlabsThatLookAlike",  // 1.2 m a frame: two slabs
       {"--road", "slabs", "--seed", "2", "--speed", "12", "--camera-height", "1.2", "--tilt-deg",
        "-5", "--frames", "100"},
       Outcome::kHonest},
      {"SlabsUnderExposureJumps",  // tracks slip back by a slab: a car that turns round in 33 ms
       {"--road",
        "slabs",
        "--seed",
        "5",
        "--frames",
        "160",
        "--fps",
        "30",
        "--speed",
        "10.2",
        "--camera-height",
        "1.91",
        "--tilt-deg",
        "5.4",
        "--route",
        "straight",
        "--traffic",
        "overtaking",
        "--suspension-pitch",
        "0.69",
        "--suspension-roll",
        "0.23",
        "--slope",
        "-4",
        "--scenery",
        "far",
        "--exposure-jumps",
        "--rolling-shutter",
        "0.01",
        "--noise",
        "1"},
       Outcome::kHonest},
      {"WetRoad", {"--road", "wet", "--frames", "100"}, Outcome::kRight},
      {"StopAndGo", {"--hard", "stop-and-go"}, Outcome::kRight},
      {"Roundabout", {"--hard", "roundabout"}, Outcome::kRight},
      {"Overtaking", {"--hard", "overtaking"}, Outcome::kRight},
      {"Oncoming", {"--hard", "oncoming"}, Outcome::kRight},
      {"TruckAhead", {"--hard", "truck"}, Outcome::kHonest},
      {"TruckAheadSwinging", {"--hard", "truck-swing"}, Outcome::kHonest},
      {"TruckInAQueue", {"--hard", "queue"}, Outcome::kRight},
      {"TruckThatMovesOff", {"--hard", "queue", "--seed", "3"}, Outcome::kHonest},
      {"JamUnderClouds",
       {"--hard", "stop-and-go", "--traffic", "crossing", "--scenery", "far", "--fps", "15",
        "--frames", "160"},
       Outcome::kRight},
      {"BusWhileStanding", {"--hard", "bus"}, Outcome::kRight},
      {"RedLight", {"--hard", "red-light"}, Outcome::kRight},
      {"RearCamera", {"--hard", "rear"}, Outcome::kRight},
      {"LeftCamera", {"--hard", "left"}, Outcome::kHonest},
      {"RightCamera", {"--hard", "right"}, Outcome::kHonest},
      {"UpsideDown", {"--hard", "upside-down"}, Outcome::kRight},
      {"Portrait", {"--hard", "portrait"}, Outcome::kRight},
      // The log is silent about the mount, as most are; somebody measured the height.
      {"UpsideDownUntold", {"--hard", "upside-down", "--silent-mount"}, Outcome::kHonest, kHeight},
      {"PortraitUntold", {"--hard", "portrait", "--silent-mount"}, Outcome::kHonest, kHeight},
      {"PitchedUpUntold",
       {"--frames", "60", "--tilt-deg", "12", "--silent-mount"},
       Outcome::kRight,
       kHeight},
      {"PitchedDownUntold",
       {"--frames", "60", "--tilt-deg", "-6", "--silent-mount"},
       Outcome::kRight,
       kHeight},
      {"RearUntold", {"--hard", "rear", "--silent-mount"}, Outcome::kHonest, kHeight},
      {"RearToldByAFlag",
       {"--hard", "rear", "--silent-mount", "--frames", "60"},
       Outcome::kRight,
       {"--camera-height", "1.5", "--mount-yaw", "180"}},
      {"UpsideDownToldByAFlag",
       {"--hard", "upside-down", "--silent-mount", "--frames", "60"},
       Outcome::kRight,
       {"--camera-height", "1.5", "--mount-roll", "180"}},
      {"PortraitToldByAFlag",
       {"--hard", "portrait", "--silent-mount", "--frames", "60"},
       Outcome::kRight,
       {"--camera-height", "1.5", "--mount-roll", "90"}},
      {"LeftToldByAFlag",
       {"--hard", "left", "--silent-mount", "--frames", "60"},
       Outcome::kRight,
       {"--camera-height", "1.5", "--mount-yaw", "90", "--mount-pitch", "5"}},
      {"LeftToldWithoutItsPitch",
       {"--hard", "left", "--silent-mount", "--frames", "60"},
       Outcome::kHonest,
       {"--camera-height", "1.5", "--mount-yaw", "90"}},
      {"CalibrationOfFullSize",
       {"--frames", "100", "--calibration-error", "full-size"},
       Outcome::kHonest},
      {"FocalLengthOfFivePixels",
       {"--frames", "100", "--calibration-error", "focal-5"},
       Outcome::kHonest},
      {"PrincipalPointSwapped",
       {"--frames", "100", "--calibration-error", "swapped"},
       Outcome::kHonest},
      {"FocalLengthTenPercentLong",
       {"--frames", "100", "--calibration-error", "focal-10-percent"},
       Outcome::kHonest},
  };
  return kRows;
}

/// Rows that fail today; each leaves the list with the change that mends it. All rows run with
/// ONEAC_HARD_DRIVES=all in the environment.
const std::vector<std::string> kNotYet = {"RainAtNight", "SlabsUnderExposureJumps"};

constexpr double kLengthBound = 0.03;     // of the true way
constexpr double kStandingBound_m = 0.1;  // where the true way is short

/// Sums over some pairs.
struct Way {
  double estimated = 0.0;
  double truth = 0.0;

  [[nodiscard]] bool is_right() const {
    return std::abs(estimated - truth) <= std::max(kLengthBound * truth, kStandingBound_m);
  }
};

struct Verdict {
  int exit_code = -1;
  Way all;     ///< the trajectory's length
  Way metric;  ///< of the pairs called metric
  std::size_t pairs = 0;
  std::size_t moving = 0;
  std::size_t metric_pairs = 0;
  std::size_t bad = 0;        ///< pairs called ok, in a wrong basin
  std::size_t no_motion = 0;  ///< pairs called so on steps of more than 5 cm
  std::string notes;

  [[nodiscard]] bool is_right() const {
    return exit_code == 0 && bad == 0 && metric_pairs > 0 && all.is_right() && metric.is_right();
  }
  [[nodiscard]] bool is_metric_and_wrong() const {
    return metric_pairs > 0 && (bad > 0 || !metric.is_right());
  }
  [[nodiscard]] bool is_honest() const {
    return is_right() || (!is_metric_and_wrong() && !notes.empty());
  }
  [[nodiscard]] const char* word() const {
    if (is_right()) return "right";
    if (is_metric_and_wrong()) return "metric and wrong";
    return is_honest() ? "honest" : "silent";
  }
};

double path_of(const std::vector<Eigen::Isometry3d>& poses) {
  double length = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    length += (poses[i].translation() - poses[i - 1].translation()).norm();
  }
  return length;
}

void judge_pairs(const std::vector<RelativePoseRow>& pairs, const Trajectory& truth,
                 Verdict& verdict) {
  constexpr double kSmallStep_m = 0.05;
  const Evaluation evaluation = evaluate_pairs(pairs, truth);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const PairError& error = evaluation.pairs[i];
    const bool ok = pairs[i].status == "ok";
    ++verdict.pairs;
    if (error.is_moving()) ++verdict.moving;
    if (ok && error.is_bad()) ++verdict.bad;
    if (pairs[i].status == "no_motion" && error.true_step > kSmallStep_m) ++verdict.no_motion;
    if (!pairs[i].metric) continue;
    ++verdict.metric_pairs;
    verdict.metric.estimated += pairs[i].T_2_1.t.norm();
    verdict.metric.truth += error.true_step;
  }
}

Verdict verdict_on(const Row& row) {
  const TemporaryFolder folder;
  const std::string drive = (folder.path() / "drive").string();
  const std::string out = (folder.path() / "out").string();
  std::vector<std::string> simulate = {ONEAC_PROGRAM, "simulate", "-o", drive, "--no-progress"};
  simulate.insert(simulate.end(), row.simulate.begin(), row.simulate.end());
  EXPECT_EQ(run_program(simulate).exit_code, 0);
  std::vector<std::string> drive_on = {ONEAC_PROGRAM, "run", drive + "/simulated.rawlog",
                                       "-o",          out,   "--no-progress"};
  drive_on.insert(drive_on.end(), row.run.begin(), row.run.end());
  const ProgramResult run = run_program(drive_on);
  Verdict verdict;
  verdict.exit_code = run.exit_code;
  verdict.notes = run.err;
  const Trajectory truth = read_kitti(drive + "/poses.txt");
  verdict.all.truth = path_of(truth.poses);
  if (!std::filesystem::exists(out + "/relative_poses.csv")) return verdict;
  verdict.all.estimated = path_of(read_kitti(out + "/trajectory_camera.kitti").poses);
  judge_pairs(read_relative_poses(out + "/relative_poses.csv"), truth, verdict);
  return verdict;
}

/// A row of the table in docs/benchmarks/hard-drives.md.
std::string table_row(const Row& row, const Verdict& v) {
  std::string flags;
  for (const std::string& word : row.simulate) flags += (flags.empty() ? "" : " ") + word;
  char text[400];
  std::snprintf(text, sizeof text,
                "| %s | `%s` | %.1f | %.1f | %zu of %zu | %.1f / %.1f | %zu | %zu | %s |", row.name,
                flags.c_str(), v.all.truth, v.all.estimated, v.metric_pairs, v.pairs,
                v.metric.estimated, v.metric.truth, v.bad, v.no_motion, v.word());
  return text;
}

void PrintTo(const Row& row, std::ostream* out) {
  *out << row.name;
}

class HardDrives : public ::testing::TestWithParam<Row> {};

TEST_P(HardDrives, IsRightOrHonest) {
  const Verdict verdict = verdict_on(GetParam());
  const std::string found = table_row(GetParam(), verdict);
  std::printf("%s\n", found.c_str());
  if (GetParam().expected == Outcome::kRight) {
    EXPECT_TRUE(verdict.is_right()) << found << '\n' << verdict.notes;
  } else {
    EXPECT_TRUE(verdict.is_honest()) << found << '\n' << verdict.notes;
  }
  EXPECT_FALSE(verdict.is_metric_and_wrong()) << found;
}

std::vector<Row> rows_to_run() {
  const char* wanted = std::getenv("ONEAC_HARD_DRIVES");
  const bool all = wanted != nullptr && std::string(wanted) == "all";
  std::vector<Row> chosen;
  for (const Row& row : rows()) {
    const bool waits = std::find(kNotYet.begin(), kNotYet.end(), row.name) != kNotYet.end();
    if (all || !waits) chosen.push_back(row);
  }
  return chosen;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, HardDrives, ::testing::ValuesIn(rows_to_run()),
                         [](const auto& row) { return std::string(row.param.name); });

/// A name in kNotYet that is no row would hide nothing and look as if it did.
TEST(HardDrivesList, NamesRowsOnly) {
  for (const std::string& name : kNotYet) {
    EXPECT_TRUE(std::any_of(rows().begin(), rows().end(), [&](const Row& row) {
      return row.name == name;
    })) << name;
  }
}

}  // namespace
}  // namespace oneac
