#include "evaluation_test_tools.h"

#include "oneac/base/error.h"
#include "oneac/evaluation/trajectory_io.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace oneac {
namespace {

class TrajectoryForms : public ::testing::Test {
 protected:
  [[nodiscard]] TrajectoryFile read(const std::string& text) const {
    const auto path = folder_.path() / "poses.txt";
    std::ofstream(path, std::ios::binary) << text;
    return read_trajectory_file(path);
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(TrajectoryForms, EurocHasNanosecondsAndTheScalarFirst) {
  const TrajectoryFile file = read(
      "#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], "
      "q_RS_y [], q_RS_z [], v\n"
      "1403636579763555584,1,2,3,0.6,0.8,0,0,9\n"
      "1403636579813555456,4,5,6,0.6,0.8,0,0,9\n");
  ASSERT_EQ(file.trajectory.poses.size(), 2U);
  EXPECT_NEAR(file.trajectory.times[1] - file.trajectory.times[0], 0.05, 1e-6);
  EXPECT_NEAR(file.trajectory.times[0], 1403636579.763555, 1e-5);
  EXPECT_EQ(file.trajectory.poses[1].translation(), Eigen::Vector3d(4, 5, 6));
  EXPECT_NEAR(Eigen::Quaterniond(file.trajectory.poses[0].linear()).w(), 0.6, 1e-9);
  ASSERT_EQ(file.notes.size(), 1U);
  EXPECT_NE(file.notes[0].find("nanoseconds"), std::string::npos);
}

TEST_F(TrajectoryForms, CommasWithTheScalarLastAreToldByTheirNames) {
  const TrajectoryFile file = read("time,x,y,z,qx,qy,qz,qw\n0,0,0,0,0.8,0,0,0.6\n");
  // The line of names is no comment.
  EXPECT_NEAR(Eigen::Quaterniond(file.trajectory.poses[0].linear()).w(), 0.6, 1e-9);
}

TEST_F(TrajectoryForms, ColumnsAreTakenByTheirNamesWhereverTheyStand) {
  const TrajectoryFile file =
      read("frame,qw,qx,qy,qz,time,y,x,z\n7,0.6,0.8,0,0,0.5,2,1,3\n8,0.6,0.8,0,0,0.6,5,4,6\n");
  EXPECT_EQ(file.trajectory.poses.at(1).translation(), Eigen::Vector3d(4, 5, 6));
  EXPECT_NEAR(file.trajectory.times.at(1), 0.6, 1e-12);
  EXPECT_NEAR(Eigen::Quaterniond(file.trajectory.poses[0].linear()).w(), 0.6, 1e-9);
}

TEST_F(TrajectoryForms, NamesOfAnythingElseAreRefused) {
  try {
    static_cast<void>(read("index1,index2,t1,t2,qw,qx,qy,qz,tx,ty,tz\n0,1,0,1,1,0,0,0,0,0,1\n"));
    ADD_FAILURE() << "pairs are no trajectory";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("names columns, but no time"), std::string::npos)
        << error.what();
  }
}

TEST_F(TrajectoryForms, CommasWithoutNamesAreToldByTheUnitOfTheTime) {
  const TrajectoryFile tum = read("0.5,0,0,0,0.8,0,0,0.6\n0.6,0,0,0,0.8,0,0,0.6\n");
  EXPECT_NEAR(Eigen::Quaterniond(tum.trajectory.poses[0].linear()).w(), 0.6, 1e-9);
  ASSERT_EQ(tum.notes.size(), 1U);
  EXPECT_NE(tum.notes[0].find("names no columns and is read as t, x, y, z, qx"), std::string::npos);
  for (const char* text :
       {"1403636579763555584,0,0,0,0.6,0.8,0,0\n", "1.403636579763555584e+18,0,0,0,0.6,0.8,0,0\n",
        "0,0,0,0,0.6,0.8,0,0\n50000000,0,0,0,0.6,0.8,0,0\n"}) {
    const TrajectoryFile euroc = read(text);
    EXPECT_NEAR(Eigen::Quaterniond(euroc.trajectory.poses[0].linear()).w(), 0.6, 1e-9) << text;
  }
  // The first of whole seconds, and a remark that names nothing.
  const TrajectoryFile whole = read("# sequence 3\n0,0,0,0,0.8,0,0,0.6\n1,0,0,0,0.8,0,0,0.6\n");
  EXPECT_NEAR(Eigen::Quaterniond(whole.trajectory.poses[0].linear()).w(), 0.6, 1e-9);
}

TEST_F(TrajectoryForms, SquareMatricesInOneLineOrInFour) {
  const std::string one = "1 0 0 5 0 1 0 6 0 0 1 7 0 0 0 1\n";
  const std::string four = "1 0 0 5\n0 1 0 6\n0 0 1 7\n0 0 0 1\n";
  for (const std::string& text : {one + one, four + four}) {
    const TrajectoryFile file = read(text);
    ASSERT_EQ(file.trajectory.poses.size(), 2U);
    EXPECT_FALSE(file.trajectory.has_times());
    EXPECT_EQ(file.trajectory.poses[1].translation(), Eigen::Vector3d(5, 6, 7));
  }
  EXPECT_EQ(read("0.5 1 0 0 5 0 1 0 6 0 0 1 7\n").trajectory.times.at(0), 0.5);
  EXPECT_EQ(read("0.5 " + one).trajectory.times.at(0), 0.5);
  EXPECT_THROW(static_cast<void>(read("1 0 0 5 0 1 0 6 0 0 1 7 0 0 1 1\n")), InputError);
  EXPECT_THROW(static_cast<void>(read("1 0 0 5\n0 1 0 6\n0 0 1 7\n")), InputError);
}

TEST_F(TrajectoryForms, TheUnitIsThatOfTheYearOrOfTheSpacing) {
  const std::string pose = " 0 0 0 0 0 0 1\n";
  const auto spacing = [&](const std::string& a, const std::string& b) {
    const auto times = read(a + pose + b + pose).trajectory.times;
    return times[1] - times[0];
  };
  EXPECT_NEAR(spacing("1261229980.0", "1261229980.1"), 0.1, 1e-6);
  EXPECT_NEAR(spacing("1261229980000", "1261229980100"), 0.1, 1e-6);
  EXPECT_NEAR(spacing("1261229980000000", "1261229980100000"), 0.1, 1e-6);
  EXPECT_NEAR(spacing("1261229980000000000", "1261229980100000000"), 0.1, 1e-6);
  EXPECT_NEAR(spacing("0", "0.1"), 0.1, 1e-9);
  EXPECT_NEAR(spacing("0", "100"), 0.1, 1e-9);
  EXPECT_NEAR(spacing("0", "100000"), 0.1, 1e-9);
  EXPECT_NEAR(spacing("0", "100000000"), 0.1, 1e-9);
  EXPECT_NEAR(spacing("0", "0.001"), 0.001, 1e-12);
}

TEST_F(TrajectoryForms, UnsortedAndDoubledRowsArePutRightAndTold) {
  const TrajectoryFile file =
      read("2 2 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n1 9 0 0 0 0 0 1\n3 3 0 0 0 0 0 1\n");
  EXPECT_EQ(file.trajectory.times, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(file.trajectory.poses[0].translation().x(), 1.0);
  EXPECT_EQ(file.notes.size(), 2U);
}

TEST_F(TrajectoryForms, OtherColumnsNameTheFormsThatAreRead) {
  try {
    static_cast<void>(read("1 2 3 4 5\n"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("5 columns"), std::string::npos) << error.what();
  }
  EXPECT_THROW(static_cast<void>(read("1 0 0 0 0 0 0 1\n1 2 3\n")), InputError);
}

}  // namespace
}  // namespace oneac
