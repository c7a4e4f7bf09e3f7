#include "oneac/evaluation/covariance_io.h"

#include "evaluation_test_tools.h"

#include "oneac/evaluation/trajectory_io.h"
#include "oneac/test_support/temporary_folder.h"

#include <algorithm>
#include <limits>
#include <random>
#include <sstream>
#include <stdexcept>

namespace oneac {
namespace {

std::vector<CovarianceRow> random_rows(std::size_t count) {
  std::mt19937 draw(7);
  std::normal_distribution<double> normal(0.0, 1e-3);
  std::vector<CovarianceRow> rows;
  for (std::size_t k = 0; k < count; ++k) {
    CovarianceRow row;
    row.index1 = 2 * k;
    row.index2 = 2 * k + 2;
    Eigen::Matrix<double, 6, 6> root;
    for (double& entry : root.reshaped()) entry = normal(draw);
    const Eigen::Matrix<double, 6, 6> square = root * root.transpose();
    row.covariance = 0.5 * (square + square.transpose());
    if (k % 2 == 0) row.position_sigma = Eigen::Vector3d(0.1 * static_cast<double>(k), 0.02, 1.0);
    rows.push_back(row);
  }
  return rows;
}

class CovarianceFile : public ::testing::Test {
 protected:
  std::filesystem::path file(const std::string& text) {
    return write_text(folder_.path() / "covariance.csv", text);
  }
  std::string error(const std::string& text) {
    const auto path = file(text);
    return input_error_of([&] { (void)read_covariances(path); });
  }
  TemporaryFolder folder_;
};

TEST_F(CovarianceFile, RoundTripKeepsEveryNumber) {
  const auto written = random_rows(20);
  const auto read = read_covariances(file(format_covariances(written)));
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t k = 0; k < read.size(); ++k) {
    EXPECT_EQ(read[k].index1, written[k].index1);
    EXPECT_EQ(read[k].index2, written[k].index2);
    EXPECT_EQ(read[k].covariance, written[k].covariance);
    EXPECT_EQ(read[k].position_sigma, written[k].position_sigma);
  }
}

TEST_F(CovarianceFile, SaysWhatIsWrongWithALine) {
  const std::string text = format_covariances(random_rows(2));
  const std::string head = text.substr(0, text.find('\n') + 1);
  EXPECT_NE(error("index1,index2\n0,1\n").find("is no covariance.csv"), std::string::npos);
  EXPECT_NE(error(head + "0,1,2\n").find("line 2: 3 fields, needs 26"), std::string::npos);
  std::string word = text;
  word.replace(head.size(), 1, "x");
  EXPECT_NE(error(word).find("'x' is not a whole number"), std::string::npos);
}

TEST(FormatCovariances, RefusesWhatIsNotFinite) {
  auto rows = random_rows(1);
  rows[0].covariance(2, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)format_covariances(rows), std::invalid_argument);
  rows = random_rows(1);
  rows[0].position_sigma = Eigen::Vector3d(0.0, std::numeric_limits<double>::infinity(), 0.0);
  EXPECT_THROW((void)format_covariances(rows), std::invalid_argument);
}

/// Poses with covariances, one of a drive without metres.
std::vector<PoseCovarianceRow> random_poses() {
  std::vector<PoseCovarianceRow> rows;
  for (const CovarianceRow& random : random_rows(3)) {
    PoseCovarianceRow row;
    row.index = random.index2;
    row.time_s = 1261229980.125 + 0.1 * static_cast<double>(random.index1);
    row.T_world_body.linear() =
        Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    row.T_world_body.translation() << 1.0, -2.0, 3.5;
    row.covariance = random.covariance;
    row.metric = row.has_lengths = true;
    rows.push_back(row);
  }
  rows.back().metric = rows.back().has_lengths = false;
  return rows;
}

TEST_F(CovarianceFile, OfPosesIsReadAsTheTrajectory) {
  const auto rows = random_poses();
  const Trajectory read = read_trajectory(file(format_pose_covariances(rows)));
  ASSERT_EQ(read.poses.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(read.times[i], rows[i].time_s);
    EXPECT_TRUE(read.poses[i].isApprox(rows[i].T_world_body, 1e-12));
  }
}

TEST_F(CovarianceFile, OfPosesNamesItsColumnsAndLeavesUnknownLengthsEmpty) {
  const auto rows = random_poses();
  const std::string text = format_pose_covariances(rows);
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0].substr(0, 46), "time,x,y,z,qw,qx,qy,qz,index,metric,c00,c01,c0");
  const auto commas = [](const std::string& line) {
    return std::count(line.begin(), line.end(), ',');
  };
  for (const std::string& line : lines) EXPECT_EQ(commas(line), 30);
  EXPECT_EQ(lines[1].find(",,"), std::string::npos);
  EXPECT_NE(lines[3].find(",,,"), std::string::npos);
  auto damaged = rows;
  damaged[1].covariance(2, 4) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)format_pose_covariances(damaged), std::invalid_argument);
}

TEST(PoseCovariance, IsCarriedToAnotherBodyAsDisturbedPosesAre) {
  Eigen::Isometry3d T_fixed = Eigen::Isometry3d::Identity();
  T_fixed.linear() = Eigen::AngleAxisd(1.1, Eigen::Vector3d(0, 1, 1).normalized()).matrix();
  T_fixed.translation() << 1.5, 0.2, -0.7;
  PoseCovarianceRow row = random_poses().front();
  const PoseCovarianceRow carried = carried_to(T_fixed, row);
  Eigen::Matrix<double, 6, 6> J;
  constexpr double kStep = 1e-6;
  for (int k = 0; k < 6; ++k) {
    PoseCovarianceRow disturbed = row;
    Eigen::Matrix<double, 6, 1> e = Eigen::Matrix<double, 6, 1>::Unit(k) * kStep;
    disturbed.T_world_body.linear() =
        Eigen::AngleAxisd(e.head<3>().norm(),
                          k < 3 ? Eigen::Vector3d::Unit(k) : Eigen::Vector3d::UnitX()) *
        row.T_world_body.linear();
    disturbed.T_world_body.translation() += e.tail<3>();
    const Eigen::Isometry3d moved = carried_to(T_fixed, disturbed).T_world_body;
    const Eigen::AngleAxisd turn(moved.linear() * carried.T_world_body.linear().transpose());
    J.col(k) << turn.angle() * turn.axis() / kStep,
        (moved.translation() - carried.T_world_body.translation()) / kStep;
  }
  EXPECT_TRUE(carried.covariance.isApprox(J * row.covariance * J.transpose(), 1e-5));
}

}  // namespace
}  // namespace oneac
