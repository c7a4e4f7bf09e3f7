#include "oneac/evaluation/relative_poses_io.h"

#include "evaluation_test_tools.h"

#include "oneac/test_support/temporary_folder.h"

#include <cmath>
#include <stdexcept>

namespace oneac {
namespace {

const std::string kHeader = "index1,index2,t1,t2,qw,qx,qy,qz,tx,ty,tz,metric,inliers,acs,status\n";
const std::string kHeaderNow =
    "index1,index2,t1,t2,qw,qx,qy,qz,tx,ty,tz,metric,inliers,acs,status,sigma_length\n";
const std::string kRow = "4,6,10.0,10.2,1,0,0,0,0,0,-1,1,30,40,ok\n";

std::vector<RelativePoseRow> random_rows(int count) {
  SceneGenerator scenes(5);
  std::vector<RelativePoseRow> rows;
  for (int k = 0; k < count; ++k) {
    RelativePoseRow row;
    row.index1 = 3 * static_cast<std::size_t>(k);
    row.index2 = row.index1 + 3;
    row.t1 = 1229456789.123456 + 0.05 * k;
    row.t2 = row.t1 + 0.05;
    row.T_2_1 = scenes.general_motion();
    row.metric = k % 2 == 0;
    row.inliers = k;
    row.acs = 2 * k;
    row.status = k % 2 == 0 ? "ok" : "few_acs";
    if (row.metric) row.sigma_length = 0.01 + 1.0 / (k + 3);
    rows.push_back(row);
  }
  return rows;
}

enum class Outcome { kSlid };

const char* to_string(Outcome /*outcome*/) {
  return "slid";
}

/// What a front end gives of a step, and more.
struct Step {
  std::size_t index1 = 3, index2 = 5, segment = 9;
  double time1 = 1.5, time2 = 1.6;
  RelativePose pose{Eigen::Matrix3d::Identity(), {0.0, 0.0, -1.25}};
  bool metric = true;
  std::size_t inliers = 7, acs = 11;
  Outcome status = Outcome::kSlid;
};

TEST(RelativePoseRow, HoldsWhatAStepSays) {
  const RelativePoseRow row = row_of(Step{}, 0.25);
  EXPECT_EQ(format_relative_poses({row}),
            kHeaderNow + "3,5,1.500000,1.600000,1,0,0,0,0,0,-1.25,1,7,11,slid,0.25\n");
}

class RelativePosesFile : public ::testing::Test {
 protected:
  std::filesystem::path file(const std::string& text) {
    return write_text(folder_.path() / "relative_poses.csv", text);
  }
  std::string error(const std::string& text) {
    const auto path = file(text);
    return input_error_of([&] { (void)read_relative_poses(path); });
  }
  TemporaryFolder folder_;
};

TEST_F(RelativePosesFile, RoundTripKeepsEveryField) {
  const auto written = random_rows(50);
  const auto read = read_relative_poses(file(format_relative_poses(written)));
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t k = 0; k < read.size(); ++k) {
    EXPECT_EQ(read[k].index1, written[k].index1);
    EXPECT_EQ(read[k].index2, written[k].index2);
    EXPECT_EQ(read[k].t1, written[k].t1);
    EXPECT_EQ(read[k].t2, written[k].t2);
    EXPECT_LT((read[k].T_2_1.R - written[k].T_2_1.R).norm(), 1e-9);
    EXPECT_EQ(read[k].T_2_1.t, written[k].T_2_1.t);
    EXPECT_EQ(read[k].metric, written[k].metric);
    EXPECT_EQ(read[k].inliers, written[k].inliers);
    EXPECT_EQ(read[k].acs, written[k].acs);
    EXPECT_EQ(read[k].status, written[k].status);
    EXPECT_EQ(read[k].sigma_length, written[k].sigma_length);
  }
}

TEST_F(RelativePosesFile, FilesFromBeforeTheSigmaAreRead) {
  const auto rows = read_relative_poses(file(kHeader + kRow));
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].status, "ok");
  EXPECT_FALSE(rows[0].sigma_length.has_value());
}

TEST_F(RelativePosesFile, RefusesANegativeSigma) {
  EXPECT_NE(error(kHeaderNow + "4,6,10.0,10.2,1,0,0,0,0,0,-1,1,30,40,ok,-0.1\n")
                .find("sigma_length is '-0.1'"),
            std::string::npos);
}

TEST_F(RelativePosesFile, ALineCutBeforeTheSigmaIsRefused) {
  EXPECT_NE(error(kHeaderNow + kRow).find("15 fields, needs 16"), std::string::npos);
}

TEST(FormatRelativePoses, WritesTheDocumentedColumns) {
  RelativePoseRow row;
  row.index2 = 1;
  row.t2 = 0.1;
  row.T_2_1.t << 0, 0, -0.5;
  row.metric = true;
  row.inliers = 7;
  row.acs = 9;
  row.status = "ok";
  EXPECT_EQ(format_relative_poses({row}),
            kHeaderNow + "0,1,0.000000,0.100000,1,0,0,0,0,0,-0.5,1,7,9,ok,\n");
  row.sigma_length = 0.25;
  EXPECT_EQ(format_relative_poses({row}),
            kHeaderNow + "0,1,0.000000,0.100000,1,0,0,0,0,0,-0.5,1,7,9,ok,0.25\n");
}

TEST(FormatRelativePoses, RefusesWhatCannotBeRead) {
  auto sigmas = random_rows(1);
  sigmas[0].sigma_length = -1.0;
  EXPECT_THROW((void)format_relative_poses(sigmas), std::invalid_argument);
  auto rows = random_rows(1);
  rows[0].status = "too, few";
  EXPECT_THROW((void)format_relative_poses(rows), std::invalid_argument);
  rows = random_rows(1);
  rows[0].T_2_1.t.x() = std::nan("");
  EXPECT_THROW((void)format_relative_poses(rows), std::invalid_argument);
}

TEST_F(RelativePosesFile, ColumnsAreFoundByNameInAnyOrder) {
  const auto rows = read_relative_poses(
      file("status,note,acs,inliers,metric,tz,ty,tx,qz,qy,qx,qw,t2,t1,index2,index1\n"
           "ok,x,40,30,0,3,2,1,0.6,0,0,0.8,10.2,10,6,4\r\n"));
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].index1, 4U);
  EXPECT_EQ(rows[0].index2, 6U);
  EXPECT_EQ(rows[0].t1, 10.0);
  EXPECT_EQ(rows[0].T_2_1.t, Eigen::Vector3d(1, 2, 3));
  const Eigen::Matrix3d R = Eigen::Quaterniond(0.8, 0, 0, 0.6).toRotationMatrix();
  EXPECT_TRUE(rows[0].T_2_1.R.isApprox(R, 1e-12));
  EXPECT_FALSE(rows[0].metric);
  EXPECT_EQ(rows[0].acs, 40);
  EXPECT_EQ(rows[0].status, "ok");
}

TEST_F(RelativePosesFile, MissingColumnIsNamedWithTheHeaderAsCure) {
  const auto message = error("index1,index2,t1,t2,qw,qx,qy,qz,tx,ty,metric,inliers,acs,status\n");
  expect_contains(message, "relative_poses.csv: line 1: no column 'tz'");
  expect_contains(message, "index1,index2,t1,t2,qw");
}

TEST_F(RelativePosesFile, ACutLastLineIsNamed) {
  expect_contains(error(kHeader + kRow + "5,6,10.0"), "line 3: 3 fields, needs 15");
}

TEST_F(RelativePosesFile, BadFieldsNameLineAndColumn) {
  expect_contains(error(kHeader + "4,6,10,10,1,0,0,0,0,nan,-1,1,3,4,ok\n"),
                  "line 2: ty is 'nan', must be a finite number");
  expect_contains(error(kHeader + "-4,6,10,10,1,0,0,0,0,0,-1,1,3,4,ok\n"),
                  "index1 is '-4', must be a whole number");
  expect_contains(error(kHeader + "4,6,10,10,1,0,0,0,0,0,-1,yes,3,4,ok\n"),
                  "metric is 'yes', must be 0 or 1");
  expect_contains(error(kHeader + "4,6,10,10,1,1,0,0,0,0,-1,1,3,4,ok\n"), "unit quaternion");
}

TEST_F(RelativePosesFile, EmptyAndMissingFilesAreNamed) {
  expect_contains(error(""), "is empty");
  expect_contains(error("\n\n"), "is blank");
  expect_contains(input_error_of([&] { (void)read_relative_poses(folder_.path() / "none.csv"); }),
                  "none.csv: no such file");
}

TEST_F(RelativePosesFile, IsToldFromATrajectoryByItsHeader) {
  EXPECT_TRUE(looks_like_relative_poses(file(kHeader + kRow)));
  EXPECT_FALSE(looks_like_relative_poses(file("1 0 0 0 0 1 0 0 0 0 1 0\n")));
  EXPECT_FALSE(looks_like_relative_poses(folder_.path() / "none.csv"));
}

TEST(FormatTimings, WritesMillisecondsWithThreeDecimals) {
  EXPECT_EQ(format_timings({{3, 4, 1.23456, 100.0, 0.0005, -1e-9}}),
            "index1,index2,ms_decode,ms_features,ms_estimate,ms_refine\n"
            "3,4,1.235,100.000,0.001,0.000\n");
  EXPECT_THROW((void)format_timings({{0, 1, std::nan(""), 0, 0, 0}}), std::invalid_argument);
}

}  // namespace
}  // namespace oneac
