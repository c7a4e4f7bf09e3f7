#include "oneac/evaluation/trajectory_io.h"

#include "evaluation_test_tools.h"

#include "oneac/test_support/temporary_folder.h"

#include <clocale>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace oneac {
namespace {

const std::string kIdentityRow = "1 0 0 0 0 1 0 0 0 0 1 0\n";

Trajectory winding_trajectory() {
  Trajectory trajectory;
  trajectory.poses = winding_drive(200, 11);
  for (int k = 0; k < 200; ++k) trajectory.times.push_back(1229456789.123456 + 0.05 * k);
  return trajectory;
}

double largest_difference(const Trajectory& a, const Trajectory& b) {
  EXPECT_EQ(a.poses.size(), b.poses.size());
  double largest = 0.0;
  for (std::size_t k = 0; k < std::min(a.poses.size(), b.poses.size()); ++k) {
    const auto difference = (a.poses[k].matrix() - b.poses[k].matrix()).cwiseAbs();
    largest = std::max(largest, difference.maxCoeff());
  }
  return largest;
}

class TrajectoryFiles : public ::testing::Test {
 protected:
  std::filesystem::path file(const std::string& name, const std::string& text) {
    return write_text(folder_.path() / name, text);
  }
  std::string kitti_error(const std::string& text) {
    const auto path = file("bad.kitti", text);
    return input_error_of([&] { (void)read_kitti(path); });
  }
  std::string tum_error(const std::string& text) {
    const auto path = file("bad.tum", text);
    return input_error_of([&] { (void)read_tum(path); });
  }
  TemporaryFolder folder_;
};

TEST_F(TrajectoryFiles, KittiRoundTripKeepsPoses) {
  const Trajectory written = winding_trajectory();
  const Trajectory read = read_kitti(file("a.kitti", format_kitti(written)));
  EXPECT_LT(largest_difference(written, read), 1e-9);
  EXPECT_FALSE(read.has_times());
}

TEST_F(TrajectoryFiles, TumRoundTripKeepsPosesAndExactTimes) {
  const Trajectory written = winding_trajectory();
  const Trajectory read = read_tum(file("a.tum", format_tum(written)));
  EXPECT_LT(largest_difference(written, read), 1e-9);
  EXPECT_EQ(written.times, read.times);
}

TEST_F(TrajectoryFiles, KittiRowHoldsTheMatrixRowByRow) {
  // 90° about Y: Z of the body points along X of the world.
  const auto T = read_kitti(file("a.kitti", "0 0 1 10  0 1 0 20  -1 0 0 30\n")).poses.at(0);
  EXPECT_TRUE((T * Eigen::Vector3d(0, 0, 1)).isApprox(Eigen::Vector3d(11, 20, 30)));
}

TEST_F(TrajectoryFiles, TumRowHoldsTheScalarOfTheQuaternionLast) {
  const Trajectory read = read_tum(file("a.tum", "5.25 1 2 3 0 0.6 0 0.8\n"));
  EXPECT_EQ(read.times.at(0), 5.25);
  EXPECT_TRUE(read.poses[0].translation().isApprox(Eigen::Vector3d(1, 2, 3)));
  const Eigen::AngleAxisd yaw(2.0 * std::atan2(0.6, 0.8), Eigen::Vector3d::UnitY());
  EXPECT_TRUE(read.poses[0].linear().isApprox(yaw.toRotationMatrix(), 1e-12));
}

TEST_F(TrajectoryFiles, CommentsBlankLinesAndWindowsLineEndsArePassedOver) {
  const auto path = file("a.kitti", "# header\r\n\r\n+1 0 0 0 0 1 0 0 0 0 1 1e1\r\n");
  const Trajectory read = read_kitti(path);
  ASSERT_EQ(read.poses.size(), 1U);
  EXPECT_EQ(read.poses[0].translation().z(), 10.0);
}

TEST_F(TrajectoryFiles, RoundedRotationsAreMadeOrthonormal) {
  const auto path = file("a.kitti", "0.9553 0 0.2955 0 0 1 0 0 -0.2955 0 0.9553 0\n");
  const Eigen::Matrix3d R = read_kitti(path).poses.at(0).linear();
  EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 1e-14);
}

TEST_F(TrajectoryFiles, FormatIsToldByNameThenByColumns) {
  EXPECT_FALSE(read_trajectory(file("poses.txt", kIdentityRow)).has_times());
  EXPECT_TRUE(read_trajectory(file("tum.txt", "1 0 0 0 0 0 0 1\n")).has_times());
  const auto misnamed = file("a.tum", kIdentityRow);
  expect_contains(input_error_of([&] { (void)read_trajectory(misnamed); }), "12 columns");
  const auto neither = file("n.txt", "\n1 2 3\n");
  const auto message = input_error_of([&] { (void)read_trajectory(neither); });
  expect_contains(message, "n.txt: line 2: 3 columns, must be 12 (KITTI) or 8 (TUM)");
}

TEST_F(TrajectoryFiles, WrongColumnCountNamesFileAndLine) {
  const auto message = kitti_error(kIdentityRow + "1 0 0 0 0 1 0 0 0 0 1\n");
  expect_contains(message, "bad.kitti: line 2: 11 columns, must be 12");
}

TEST_F(TrajectoryFiles, NumbersThatAreNotFiniteNameTheColumn) {
  expect_contains(kitti_error("1 0 0 nan 0 1 0 0 0 0 1 0\n"), "line 1: column 4 is 'nan'");
  expect_contains(kitti_error("1 0 0 0 0 1 0 inf 0 0 1 0\n"), "column 8 is 'inf'");
  expect_contains(kitti_error("1 0 0 0,5 0 1 0 0 0 0 1 0\n"), "column 4 is '0,5'");
  expect_contains(kitti_error("1 0 0 0 0 1 0 1e300 0 0 1 0\n"), "column 8 is '1e300'");
  expect_contains(tum_error("x 0 0 0 0 0 0 1\n"), "column 1 is 'x'");
}

TEST_F(TrajectoryFiles, MatricesThatAreNoRotationAreRefused) {
  expect_contains(kitti_error("2 0 0 0 0 1 0 0 0 0 1 0\n"), "not a rotation");
  expect_contains(kitti_error("-1 0 0 0 0 1 0 0 0 0 1 0\n"), "not a rotation");  // a mirror
  expect_contains(tum_error("1 0 0 0 0 0 0 0\n"), "not a unit quaternion");
}

TEST_F(TrajectoryFiles, TimesThatDoNotIncreaseAreRefused) {
  const auto message = tum_error("2 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n");
  expect_contains(message, "line 2: its time is not later");
}

TEST_F(TrajectoryFiles, MissingEmptyAndBlankFilesAndFoldersAreNamed) {
  expect_contains(input_error_of([&] { (void)read_kitti(folder_.path() / "none.kitti"); }),
                  "none.kitti: no such file");
  expect_contains(kitti_error(""), "bad.kitti: is empty");
  expect_contains(kitti_error("# nothing\n\n"), "bad.kitti: has no poses");
  expect_contains(input_error_of([&] { (void)read_kitti(folder_.path()); }), "is a folder");
}

TEST(FormatKitti, WritesIdentityPlainly) {
  Trajectory trajectory;
  trajectory.poses = {pose_at(-0.0, 0.1, 0)};
  EXPECT_EQ(format_kitti(trajectory), "1 0 0 0 0 1 0 0.1 0 0 1 0\n");
}

TEST(FormatTum, WritesSixDecimalsOfTimeAndAPositiveScalar) {
  Trajectory trajectory{{1229456789.5}, {pose_at(1, 2, 3, 3.0)}};
  trajectory.poses[0].linear() = Eigen::Quaterniond(-0.8, 0, -0.6, 0).toRotationMatrix();
  const std::string text = format_tum(trajectory);
  EXPECT_EQ(text.rfind("1229456789.500000 1 2 3 ", 0), 0U) << text;
  EXPECT_EQ(text.find(" -0."), std::string::npos) << text;
}

TEST(FormatTrajectory, DoesNotDependOnTheLocale) {
  Trajectory trajectory{{0.5}, {pose_at(0.25, 0, 0)}};
  const std::string before = format_kitti(trajectory) + format_tum(trajectory);
  const std::string old = std::setlocale(LC_ALL, nullptr);
  // A comma locale where one is installed; the C locale answers the same either way.
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "es_ES.UTF-8"}) {
    if (std::setlocale(LC_ALL, name) != nullptr) break;
  }
  EXPECT_EQ(format_kitti(trajectory) + format_tum(trajectory), before);
  std::setlocale(LC_ALL, old.c_str());
}

TEST(FormatTrajectory, RefusesWhatCannotBeRead) {
  Trajectory trajectory{{}, {pose_at(0, 0, std::nan(""))}};
  EXPECT_THROW((void)format_kitti(trajectory), std::invalid_argument);
  EXPECT_THROW((void)format_tum({{}, {pose_at(0, 0, 0)}}), std::invalid_argument);
  EXPECT_THROW((void)format_tum({{1.0, 2.0}, {pose_at(0, 0, 0)}}), std::invalid_argument);
  const Trajectory standing_clock{{1.0, 1.0}, {pose_at(0, 0, 0), pose_at(0, 0, 0)}};
  EXPECT_THROW((void)format_tum(standing_clock), std::invalid_argument);
}

}  // namespace
}  // namespace oneac
