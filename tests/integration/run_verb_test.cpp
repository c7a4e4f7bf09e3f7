#include "drive_fixture.h"

#include "oneac/evaluation/covariance_io.h"
#include "oneac/evaluation/relative_poses_io.h"
#include "oneac/evaluation/trajectory_io.h"

#include <Eigen/Dense>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

namespace oneac {
namespace {

namespace fs = std::filesystem;

class RunVerb : public DriveFixture {
 protected:
  [[nodiscard]] fs::path run(const std::string& name, std::vector<std::string> extra = {}) const {
    fs::path folder = scratch() / name;
    std::vector<std::string> arguments{"run", log(), "-o", folder.string()};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    const ProgramResult result = oneac_program(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return folder;
  }
  [[nodiscard]] static std::string summary_without_timing(const fs::path& folder) {
    auto json = nlohmann::json::parse(read_file(folder / "summary.json"));
    json.erase("timing");
    return json.dump();
  }
};

TEST_F(RunVerb, WritesARowForEveryProcessedFrame) {
  const fs::path out = run("a");
  EXPECT_EQ(read_kitti(out / "trajectory_camera.kitti").poses.size(), std::size_t{kFrames});
  EXPECT_EQ(read_tum(out / "trajectory_camera.tum").poses.size(), std::size_t{kFrames});
  EXPECT_EQ(read_tum(out / "trajectory_vehicle.tum").poses.size(), std::size_t{kFrames});
  EXPECT_EQ(read_relative_poses(out / "relative_poses.csv").size(), std::size_t{kFrames - 1});
  EXPECT_TRUE(read_kitti(out / "trajectory_camera.kitti").poses.front().matrix().isIdentity());
}

TEST_F(RunVerb, WritesTheColumnsThatOthersScriptAgainst) {
  const fs::path out = run("a");
  const auto first_line = [](const std::string& text) { return text.substr(0, text.find('\n')); };
  EXPECT_EQ(first_line(read_file(out / "relative_poses.csv")),
            "index1,index2,t1,t2,qw,qx,qy,qz,tx,ty,tz,metric,inliers,acs,status,sigma_length");
  EXPECT_EQ(first_line(read_file(out / "covariance.csv")),
            "index1,index2,c00,c01,c02,c03,c04,c05,c11,c12,c13,c14,c15,c22,c23,c24,c25,c33,c34,c35,"
            "c44,c45,c55,sigma_x,sigma_y,sigma_z");
  EXPECT_EQ(first_line(read_file(out / "tilt.csv")),
            "index,time,pitch_up_deg,pitch_sigma_deg,roll_right_deg,roll_sigma_deg,"
            "suspension_pitch_deg,suspension_sigma_deg");
  EXPECT_EQ(first_line(read_file(out / "timings.csv")),
            "index1,index2,ms_decode,ms_features,ms_estimate,ms_refine");
}

/// Sum over the edges of the variance of rotation [rad²], about all axes.
double rotation_variance_of_graph(const std::string& graph) {
  double sum = 0.0;
  std::istringstream lines(graph);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word;
    for (int skipped = 0; skipped < 10; ++skipped) words >> word;  // tag, two ids, seven of a pose
    if (line.rfind("EDGE_SE3:QUAT", 0) != 0) continue;
    Eigen::Matrix<double, 6, 6> information;
    for (int r = 0; r < 6; ++r) {
      for (int c = r; c < 6; ++c) {
        words >> information(r, c);
        information(c, r) = information(r, c);
      }
    }
    sum += 4.0 * information.inverse().bottomRightCorner<3, 3>().trace();  // of half an angle
  }
  return sum;
}

// The window's own information is that of a keyframe whose landmarks are known: a hundredth.
TEST_F(RunVerb, EdgesOfTheGraphAreAsUncertainAsTheirPairs) {
  const fs::path out = run("a");
  double of_pairs = 0.0;
  for (const CovarianceRow& row : read_covariances(out / "covariance.csv")) {
    of_pairs += row.covariance.topLeftCorner<3, 3>().trace();
  }
  const double of_graph = rotation_variance_of_graph(read_file(out / "graph.g2o"));
  ASSERT_GT(of_pairs, 0.0);
  EXPECT_LT(of_graph, 1.01 * of_pairs);
  EXPECT_GT(of_graph, 0.7 * of_pairs) << "but for the frames behind the last keyframe";
}

TEST_F(RunVerb, GivesTheSameBytesAtAnyThreadCount) {
  const fs::path one = run("one", {"--threads", "1"});
  for (const char* threads : {"2", "4", "8"}) {
    const fs::path more = run(threads, {"--threads", threads});
    for (const char* name :
         {"trajectory_camera.kitti", "trajectory_camera.tum", "trajectory_camera.csv",
          "trajectory_vehicle.tum", "relative_poses.csv", "covariance.csv", "keyframes.tum",
          "graph.g2o", "points.ply", "params.yaml"}) {
      EXPECT_EQ(read_file(one / name), read_file(more / name)) << name << ", " << threads;
    }
    EXPECT_EQ(summary_without_timing(one), summary_without_timing(more)) << threads;
  }
}

TEST_F(RunVerb, CountsIndicesInTheLogBeforeThinning) {
  const auto rows =
      read_relative_poses(run("a", {"--first", "1", "--every", "3"}) / "relative_poses.csv");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].index1, 1U);
  EXPECT_EQ(rows[0].index2, 4U);
  EXPECT_EQ(rows[1].index2, 7U);
  const auto few = read_relative_poses(run("b", {"--count", "3"}) / "relative_poses.csv");
  EXPECT_EQ(few.size(), 2U);
}

TEST_F(RunVerb, IsNotMetricWithoutACameraHeight) {
  // A sensor pose at the vehicle's origin does not tell the height.
  const fs::path drive_2 = scratch() / "low";
  ASSERT_EQ(oneac_program({"simulate", "-o", drive_2.string(), "--frames", "4", "--width", "320",
                           "--height", "240", "--focal", "250", "--camera-height", "0.4"})
                .exit_code,
            0);
  const fs::path out = scratch() / "low_out";
  const ProgramResult result =
      oneac_program({"run", (drive_2 / "simulated.rawlog").string(), "-o", out.string()});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.err.find("--camera-height"), std::string::npos) << result.err;
  for (const auto& row : read_relative_poses(out / "relative_poses.csv")) {
    if (row.status != "ok") continue;
    EXPECT_FALSE(row.metric);
    EXPECT_NEAR(row.T_2_1.t.norm(), 1.0, 1e-9);
  }
  EXPECT_EQ(nlohmann::json::parse(read_file(out / "summary.json"))["metric"], "none");
}

TEST_F(RunVerb, SaysWhatItLearnedOfTheCar) {
  const fs::path with_bonnet = scratch() / "bonnet", out = scratch() / "bonnet_out";
  ASSERT_EQ(
      oneac_program({"simulate", "-o", with_bonnet.string(), "--frames", "30", "--bonnet", "0.25"})
          .exit_code,
      0);
  const ProgramResult result =
      oneac_program({"run", (with_bonnet / "simulated.rawlog").string(), "-o", out.string()});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.out.find("learned as the car's own: "), std::string::npos) << result.out;
  EXPECT_TRUE(fs::exists(out / "mask.png"));
  EXPECT_NE(read_file(out / "report.html").find("What belongs to the car"), std::string::npos);
  const auto summary = nlohmann::json::parse(read_file(out / "summary.json"));
  EXPECT_GT(summary["car_mask_share"], 0.05);
  EXPECT_LT(summary["car_mask_share"], 0.25);
  EXPECT_EQ(summary["car_mask_refused"], false);
  const fs::path bare = run("a");
  EXPECT_FALSE(fs::exists(bare / "mask.png"));
  EXPECT_EQ(nlohmann::json::parse(read_file(bare / "summary.json"))["car_mask_share"], 0.0);
}

TEST_F(RunVerb, ComparesWithThePosesBesideTheLog) {
  const auto json = nlohmann::json::parse(read_file(run("a") / "summary.json"));
  EXPECT_FALSE(json["reference"]["errors"].is_null());
  EXPECT_EQ(json["counts"]["frames"], kFrames);
}

TEST_F(RunVerb, TakesKeysFromFilesSettingsAndFlagsInThisOrder) {
  write_text(scratch() / "p.yaml", "source:\n  count: 3\nfront_end:\n  consensus:\n    modes: 3\n");
  const std::string params = (scratch() / "p.yaml").string();
  const fs::path out = run("a", {"--params", params, "--set", "front_end.consensus.modes=5"});
  EXPECT_EQ(read_relative_poses(out / "relative_poses.csv").size(), 2U);
  const std::string effective = read_file(out / "params.yaml");
  EXPECT_NE(effective.find("modes: 5"), std::string::npos);
  EXPECT_EQ(
      read_relative_poses(run("b", {"--params", params, "--count", "4"}) / "relative_poses.csv")
          .size(),
      3U);
}

TEST_F(RunVerb, TakesTheExtractorAsAFlag) {
  const fs::path out = run("sift", {"--features", "sift", "--count", "3"});
  EXPECT_NE(read_file(out / "params.yaml").find("extractor: \"sift\""), std::string::npos);
}

TEST_F(RunVerb, EffectiveParametersRepeatTheRun) {
  const fs::path a = run("a", {"--set", "front_end.consensus.modes=4", "--every", "2"});
  const fs::path b = run("b", {"--params", (a / "params.yaml").string()});
  EXPECT_EQ(read_file(a / "relative_poses.csv"), read_file(b / "relative_poses.csv"));
}

TEST_F(RunVerb, ShippedDefaultsAreThoseOfTheProgram) {
  const ProgramResult result = oneac_program({"run", "--print-params"});
  const std::string shipped = read_file(fs::path(ONEAC_SOURCE_DIR) / "params" / "default.yaml");
  EXPECT_EQ(shipped.substr(shipped.find("source:")), result.out)
      << "renew with: oneac run --print-params";
}

TEST_F(RunVerb, FlagsDoNotSwallowTheLogBehindThem) {
  write_text(scratch() / "p.yaml", "source:\n  count: 3\n");
  const ProgramResult result =
      oneac_program({"run", "--params", (scratch() / "p.yaml").string(), "--set",
                     "front_end.consensus.modes=4", log(), "-o", out()});
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(RunVerb, QuietSaysNothingOnStderr) {
  const ProgramResult result = oneac_program({"run", log(), "-o", out(), "--quiet"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
}

/// White, dark in a band across the left half; as a PGM.
void write_masks(const fs::path& images, const fs::path& masks, int width, int height) {
  fs::create_directories(masks);
  std::string pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), '\xff');
  for (int v = 0; v < height; ++v) {
    std::fill_n(pixels.begin() + v * width, width / 2, '\0');
  }
  for (const auto& entry : fs::directory_iterator(images)) {
    std::ofstream(masks / (entry.path().stem().string() + ".pgm"), std::ios::binary)
        << "P5\n"
        << width << " " << height << "\n255\n"
        << pixels;
  }
}

/// [m] to the right of the first camera, of the landmark that is farthest to its left.
double leftmost_point(const fs::path& cloud) {
  const std::string text = read_file(cloud);
  std::istringstream points(text.substr(text.find("end_header") + 11));
  double leftmost = 1e9;
  for (std::string line; std::getline(points, line);) {
    leftmost = std::min(leftmost, std::stod(line));
  }
  return leftmost;
}

TEST_F(RunVerb, MakesNothingOfWhatMasksOfSingleImagesHide) {
  const fs::path masks = scratch() / "masks";
  const cv::Mat first = cv::imread(fs::directory_iterator(drive() / "Images")->path().string());
  write_masks(drive() / "Images", masks, first.cols, first.rows);
  const ProgramResult result =
      oneac_program({"run", log(), "-o", out(), "--no-progress", "--mask-dir", masks.string()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const double masked = leftmost_point(fs::path(out()) / "points.ply");
  const ProgramResult features =
      oneac_program({"features", log(), "-o", (scratch() / "features").string(), "--no-progress",
                     "--mask-dir", masks.string()});
  ASSERT_EQ(features.exit_code, 0) << features.err;
  EXPECT_NE(read_file(fs::path(out()) / "params.yaml").find("mask_dir"), std::string::npos);
  const ProgramResult plain = oneac_program({"run", log(), "-o", out(), "--no-progress"});
  ASSERT_EQ(plain.exit_code, 0);
  EXPECT_GT(masked, -0.5);
  EXPECT_LT(leftmost_point(fs::path(out()) / "points.ply"), -2.0);
}

TEST_F(RunVerb, SaysWhichMaskIsMissingOrOfAnotherSize) {
  const fs::path masks = scratch() / "masks";
  const auto fault = [&] {
    return oneac_program(
        {"run", log(), "-o", out(), "--no-progress", "--mask-dir", masks.string()});
  };
  const ProgramResult none = fault();
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("no such folder of masks"), std::string::npos) << none.err;
  write_masks(drive() / "Images", masks, 32, 24);
  const ProgramResult small = fault();
  EXPECT_EQ(small.exit_code, 2);
  EXPECT_NE(small.err.find("the mask has 32x24 pixels"), std::string::npos) << small.err;
  EXPECT_EQ(std::count(small.err.begin(), small.err.end(), '\n'), 1) << small.err;
}

TEST_F(RunVerb, SaysThatMasksLeaveLittleOfTheImages) {
  const fs::path masks = scratch() / "masks";
  const cv::Mat first = cv::imread(fs::directory_iterator(drive() / "Images")->path().string());
  const auto told = [&] {
    return oneac_program({"run", log(), "-o", out(), "--no-progress", "--count", "5", "--mask-dir",
                          masks.string()})
        .err;
  };
  write_masks(drive() / "Images", masks, first.cols, first.rows);
  const std::string half = told();
  EXPECT_EQ(half.find("the masks leave out"), std::string::npos) << half;
  for (const auto& mask : fs::directory_iterator(masks)) {
    cv::imwrite(mask.path().string(), cv::Mat(first.rows, first.cols, CV_8U, cv::Scalar(0)));
  }
  const std::string all = told();
  EXPECT_NE(all.find("the masks leave out 100 % of the images"), std::string::npos) << all;
}

}  // namespace
}  // namespace oneac
