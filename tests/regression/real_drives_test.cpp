#include "oneac/evaluation/evaluate.h"
#include "oneac/evaluation/relative_poses_io.h"
#include "oneac/evaluation/trajectory_io.h"
#include "oneac/geometry/angular_errors.h"
#include "oneac/test_support/program.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>

namespace oneac {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// The folder of the real drives; tests/run.sh sets it and leaves these tests out without it.
std::string data_folder() {
  const char* folder = std::getenv("ONEAC_REAL_DATA");
  return folder != nullptr ? folder : std::string(ONEAC_SOURCE_DIR) + "/../shared/data";
}

std::string params(const std::string& name) {
  return std::string(ONEAC_SOURCE_DIR) + "/params/" + name;
}

std::string read_text(const std::string& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Median per component of the directions of translation.
Eigen::Vector3d median_direction(const std::vector<RelativePoseRow>& rows) {
  Eigen::Vector3d median;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    values.reserve(rows.size());
    for (const auto& row : rows) values.push_back(row.T_2_1.t.normalized()(axis));
    median(axis) = percentile(values, 50.0);
  }
  return median.normalized();
}

TEST(Malaga07, RunsNativelyFromItsOriginalRawlog) {
  const std::string data = data_folder() + "/malaga-07/";
  const std::string log = data + "malaga-urban-dataset-extract-07_CAM_GPS.rawlog";
  const TemporaryFolder folder;
  const std::string out = folder.path().string();

  const ProgramResult info = run_program({ONEAC_PROGRAM, "info", log});
  ASSERT_EQ(info.exit_code, 0) << info.err;
  for (const char* words : {"2121", "20.00 Hz", "212", "160 of 4242 present", "8.2° upward",
                            "x_forward", "106.0 s", "raw"}) {
    EXPECT_NE(info.out.find(words), std::string::npos) << words << " not in\n" << info.out;
  }

  const ProgramResult run =
      run_program({ONEAC_PROGRAM, "run", log, "-o", out, "--camera", "right", "--calibration",
                   data + "camera_params_rectified_a=0_1024x768.txt:CAMERA_RIGHT", "--params",
                   params("malaga.yaml")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_NE(run.err.find("1961 of 2121"), std::string::npos) << run.err;
  EXPECT_EQ(read_kitti(out + "/trajectory_camera.kitti").poses.size(), 160U);

  const auto rows = read_relative_poses(out + "/relative_poses.csv");
  ASSERT_EQ(rows.size(), 159U);
  const Eigen::Vector3d median = median_direction(rows);
  for (const auto& row : rows) {
    EXPECT_LE(direction_error(row.T_2_1.t, median), 5.0 * kDegree) << "pair " << row.index1;
  }
  const auto gps = nlohmann::json::parse(read_text(out + "/summary.json"))["reference"]["gps"];
  EXPECT_NEAR(gps["estimated_heading_change_deg"].get<double>(),
              gps["gps_heading_change_deg"].get<double>(), 2.0);
  EXPECT_NEAR(gps["estimated_distance"].get<double>() / gps["gps_distance_m"].get<double>(), 1.0,
              0.03);
}

/// Metres by the speeds of the GPS, nothing known of the camera's height.
TEST(Malaga07, TakesItsMetresFromTheGps) {
  const std::string data = data_folder() + "/malaga-07/";
  const TemporaryFolder folder;
  const std::string out = folder.path().string();
  const ProgramResult run =
      run_program({ONEAC_PROGRAM, "run", data + "malaga-urban-dataset-extract-07_CAM_GPS.rawlog",
                   "-o", out, "--camera", "right", "--calibration",
                   data + "camera_params_rectified_a=0_1024x768.txt:CAMERA_RIGHT", "--set",
                   "front_end.scale.source=gps"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto summary = nlohmann::json::parse(read_text(out + "/summary.json"));
  EXPECT_EQ(summary["camera_height_m"].get<double>(), 0.0) << "the road took part";
  EXPECT_GE(summary["counts"]["steps_metric"].get<int>(), 140);
  const auto& gps = summary["reference"]["gps"];
  EXPECT_NEAR(gps["estimated_distance"].get<double>() / gps["gps_distance_m"].get<double>(), 1.0,
              0.03);
}

/// The accelerometer, without help from the drive, against the drive, without the accelerometer.
TEST(Malaga07, IsLevelledByItsImu) {
  const TemporaryFolder folder;
  const std::string log = (folder.path() / "malaga-07.rawlog").string();
  const ProgramResult import =
      run_program({ONEAC_PROGRAM, "import", "malaga", data_folder() + "/malaga-07", "-o", log});
  ASSERT_EQ(import.exit_code, 0) << import.err;
  const auto pitch = [&](const std::string& source, const std::string& refine) {
    const std::string out = (folder.path() / source).string();
    const ProgramResult run =
        run_program({ONEAC_PROGRAM, "run", log, "-o", out, "--camera", "right", "--params",
                     params("malaga.yaml"), "--set", "front_end.tilt.source=" + source, "--set",
                     "front_end.tilt.refine=" + refine});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const auto summary = nlohmann::json::parse(read_text(out + "/summary.json"));
    return summary["camera"]["tilt_used_last"]["pitch_up_deg"].get<double>();
  };
  EXPECT_NEAR(pitch("imu", "false"), pitch("drive", "true"), 0.5);
}

/// Copies the folder's small files and refers to its images, the GPS moved in time.
std::filesystem::path malaga_04a_with_gps_moved(const TemporaryFolder& folder, double seconds) {
  namespace fs = std::filesystem;
  const fs::path from = data_folder() + "/malaga-04a", to = folder.path() / "moved";
  fs::create_directories(to);
  fs::create_directory_symlink(fs::absolute(from / "Images"), to / "Images");
  for (const auto& entry : fs::directory_iterator(from)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream in(entry.path());
    std::ofstream out(to / entry.path().filename());
    const bool gps = entry.path().string().find("_GPS") != std::string::npos;
    for (std::string line; std::getline(in, line);) {
      const bool moved = gps && !line.empty() && line.front() != '%';
      std::size_t used = 0;
      if (moved) out << std::fixed << std::stod(line, &used) + seconds;
      out << line.substr(used) << '\n';
    }
  }
  return to;
}

class Malaga04a : public testing::Test {
 protected:
  /// Metres by the GPS, whose text holds positions without speeds.
  ProgramResult run(const std::string& source) const {
    const std::string log = (folder_.path() / "log.rawlog").string();
    const ProgramResult import =
        run_program({ONEAC_PROGRAM, "import", "malaga", source, "-o", log});
    EXPECT_EQ(import.exit_code, 0) << import.err;
    return run_program({ONEAC_PROGRAM, "run", log, "-o", out_, "--camera", "left", "--params",
                        params("malaga.yaml"), "--set", "front_end.scale.source=gps"});
  }

  const TemporaryFolder folder_;
  const std::string out_ = (folder_.path() / "out").string();
};

TEST_F(Malaga04a, TakesItsMetresFromPositionsWithoutSpeeds) {
  const ProgramResult result = run(data_folder() + "/malaga-04a");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err.find("so nothing is in metres"), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("does not overlap"), std::string::npos) << result.err;
  const auto poses = read_kitti(out_ + "/trajectory_camera.kitti").poses;
  double way = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    way += (poses[i].translation() - poses[i - 1].translation()).norm();
  }
  EXPECT_NEAR(way, 20.3, 2.03);
}

TEST_F(Malaga04a, SaysThatItsGpsIsOfAnotherTime) {
  const ProgramResult result = run(malaga_04a_with_gps_moved(folder_, 3600.0).string());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("does not overlap the images ("), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("so nothing is in metres"), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("scale.source: gps"), std::string::npos) << result.err;
}

class Kitti03 : public testing::Test {
 protected:
  void SetUp() override {
    const ProgramResult import =
        run_program({ONEAC_PROGRAM, "import", "kitti", data_folder() + "/kitti-03", "-o", log_});
    ASSERT_EQ(import.exit_code, 0) << import.err;
  }

  /// Runs the drive with these settings beside the camera's height.
  [[nodiscard]] Evaluation evaluation_with(const std::vector<std::string>& settings) const {
    const std::string out = (folder_.path() / "out").string();
    std::vector<std::string> words = {ONEAC_PROGRAM,       "run", log_, "-o", out, "--params",
                                      params("kitti.yaml")};
    for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
    const ProgramResult run = run_program(words);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return evaluate_run(read_relative_poses(out + "/relative_poses.csv"),
                        read_kitti(out + "/trajectory_camera.kitti"),
                        read_kitti(data_folder() + "/kitti-03/poses.txt"));
  }

  const TemporaryFolder folder_;
  const std::string log_ = (folder_.path() / "kitti-03.rawlog").string();
};

TEST_F(Kitti03, MeetsItsBoundsOnConsecutiveFrames) {
  EXPECT_EQ(run_program({"rawlog-edit", "--info", "-i", log_}).exit_code, 0);
  const Evaluation evaluation = evaluation_with({});
  ASSERT_TRUE(evaluation.pair_summary && evaluation.trajectory);
  const PairSummary& pairs = *evaluation.pair_summary;
  EXPECT_EQ(pairs.pairs, 399U);
  EXPECT_EQ(pairs.bad, 0U);
  EXPECT_LE(pairs.rotation->mean, 0.038 * kDegree);
  EXPECT_LE(pairs.direction->mean, 0.85 * kDegree);
  EXPECT_GE(static_cast<double>(pairs.metric), 0.9 * static_cast<double>(pairs.moving));
  EXPECT_LE(pairs.length->median, 0.03);
  const TrajectoryErrors& trajectory = *evaluation.trajectory;
  ASSERT_TRUE(trajectory.subsequences && trajectory.scale_error);
  EXPECT_LE(trajectory.subsequences->translation, 0.02);
  EXPECT_LE(trajectory.subsequences->rotation, 0.005 * kDegree);  // per metre
  EXPECT_LE(std::abs(*trajectory.scale_error), 0.02);
}

TEST_F(Kitti03, IsNearerToItsPosesByAThirdThroughRefinement) {
  const Evaluation refined = evaluation_with({});
  const Evaluation bare =
      evaluation_with({"front_end.window.enabled=false", "front_end.refine_enabled=false"});
  ASSERT_TRUE(refined.trajectory && bare.trajectory);
  EXPECT_LE(refined.trajectory->ape.rmse, 0.7 * bare.trajectory->ape.rmse);
}

/// Of one drive by other tracks, since one run of it scatters by as much as affinities bring.
TEST_F(Kitti03, TurnsAwayLessWithAffinitiesThanWithPointsAlone) {
  const auto turned_away = [this](const std::string& setting) {
    double sum = 0.0;
    for (const char* tracks : {"685", "700", "715"}) {
      const Evaluation evaluation =
          evaluation_with({setting, std::string("front_end.features.klt.max_tracks=") + tracks});
      if (!evaluation.trajectory || !evaluation.trajectory->subsequences) {
        return std::numeric_limits<double>::quiet_NaN();
      }
      sum += evaluation.trajectory->subsequences->rotation;
    }
    return sum;
  };
  EXPECT_LT(turned_away("front_end.perspective=true"), turned_away("front_end.perspective=false"));
}

/// A wide bound does to wrong motions what a small image does: they cost little. With the first
/// mode that explains the points three pairs of this drive end up to 57 degrees off.
TEST_F(Kitti03, HasNoWrongBasinWithinThreePixels) {
  const Evaluation evaluation = evaluation_with({"front_end.consensus.threshold_px=3"});
  ASSERT_TRUE(evaluation.pair_summary);
  EXPECT_EQ(evaluation.pair_summary->pairs, 399U);
  EXPECT_EQ(evaluation.pair_summary->bad, 0U);
}

}  // namespace
}  // namespace oneac
