#include "oneac/loops/graph_covariance.h"

#include "loop_scenes.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <random>
#include <vector>

namespace oneac {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr std::size_t kLap = 40;

/// Errors that are drawn anew for each drive.
struct Errors {
  double step = 1.0;           ///< times test::step_covariance() and that of loops
  double length_of_all = 0.0;  ///< relative 1σ
  double turn_of_all = 0.0;
  double rotation_of_all = 0.0;  ///< [rad] 1σ, about each axis of the camera in each step
};

Eigen::Isometry3d small(const Vector6& change) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  const double angle = change.tail<3>().norm();
  if (angle > 0.0) T.linear() = Eigen::AngleAxisd(angle, change.tail<3>() / angle).matrix();
  T.translation() = change.head<3>();
  return T;
}

/// Two laps with loops from the second to the first, as odometry and loops measure them.
struct Drive {
  std::vector<Eigen::Isometry3d> truth = test::square_drive(20.0, 2);
  std::vector<LoopKeyframe> keyframes;
  std::vector<LoopConstraint> loops;

  Drive(const Errors& errors, std::mt19937& random) {
    std::normal_distribution<double> normal;
    const double longer = errors.length_of_all * normal(random);
    const double turned = errors.turn_of_all * normal(random);
    Eigen::Vector3d rotated = Eigen::Vector3d::Zero();
    if (errors.rotation_of_all > 0.0) {
      for (double& axis : rotated) axis = errors.rotation_of_all * normal(random);
    }
    keyframes = test::drifted(truth, 0.0);
    for (std::size_t i = 1; i < truth.size(); ++i) {
      Vector6 change;
      for (int k = 0; k < 6; ++k) {
        change[k] = errors.step * std::sqrt(keyframes[i].covariance(k, k)) * normal(random);
      }
      change.tail<3>() += rotated;
      Eigen::Isometry3d step = truth[i - 1].inverse() * truth[i];
      step.translation() *= 1.0 + longer;
      const Eigen::AngleAxisd turn(step.linear());
      step.linear() = Eigen::AngleAxisd((1.0 + turned) * turn.angle(), turn.axis()).matrix();
      keyframes[i].T_first_cam = keyframes[i - 1].T_first_cam * step * small(change);
      keyframes[i].scale_sigma = errors.length_of_all;
      keyframes[i].shared_rotation.setConstant(errors.rotation_of_all);
    }
    for (std::size_t i = 4; i < kLap; i += 6) {
      LoopConstraint loop = test::loop_between(truth, i, i + kLap);
      Vector6 w;  // (w, t)
      for (int k = 0; k < 6; ++k) {
        w[k] = errors.step * std::sqrt(loop.covariance(k, k)) * normal(random);
      }
      const Eigen::Isometry3d turn = small((Vector6() << 0, 0, 0, w.head<3>()).finished());
      loop.T_2_1.R = turn.linear() * loop.T_2_1.R;
      loop.T_2_1.t = (1.0 + longer) * loop.T_2_1.t + w.tail<3>();
      loops.push_back(loop);
    }
  }
};

/// Mean square of positions and turns of keyframes against the truth, and as they are believed.
struct Spread {
  double position = 0.0, position_believed = 0.0, turn = 0.0, turn_believed = 0.0;
};

Spread spread_of(std::size_t keyframe, const Errors& errors) {
  constexpr int kDrives = 100;
  std::mt19937 random(3);
  Spread spread;
  for (int i = 0; i < kDrives; ++i) {
    const Drive drive(errors, random);
    const ClosedGraph closed = optimise_pose_graph(drive.keyframes, drive.loops);
    EXPECT_GE(closed.loops.size() + 1, drive.loops.size());
    const auto believed =
        closed_covariances(drive.keyframes, closed, {errors.length_of_all, errors.turn_of_all});
    const Eigen::Isometry3d off = closed.T_first_cam[keyframe] * drive.truth[keyframe].inverse();
    spread.position +=
        (closed.T_first_cam[keyframe].translation() - drive.truth[keyframe].translation())
            .squaredNorm() /
        kDrives;
    const double angle = Eigen::AngleAxisd(off.linear()).angle();
    spread.turn += angle * angle / kDrives;
    spread.turn_believed += believed[keyframe].topLeftCorner<3, 3>().trace() / kDrives;
    spread.position_believed += believed[keyframe].bottomRightCorner<3, 3>().trace() / kDrives;
  }
  return spread;
}

void expect_true(const Spread& spread, const char* errors) {
  EXPECT_NEAR(spread.position / spread.position_believed, 1.0, 0.3) << errors;
  EXPECT_NEAR(spread.turn / spread.turn_believed, 1.0, 0.3) << errors;
}

TEST(GraphCovariance, IsThatOfManyDrivesWithErrorsOfTheirOwn) {
  for (const std::size_t keyframe : {kLap / 2, kLap + 7, 2 * kLap - 1}) {
    expect_true(spread_of(keyframe, {}), "of steps");
  }
}

TEST(GraphCovariance, CarriesWhatAllStepsShareThroughTheLoops) {
  const std::size_t opposite = kLap / 2;
  expect_true(spread_of(opposite, {1.0, 0.03, 0.0}), "of lengths");
  // Larger ones, and the loops are taken for false: their steps do not know of it.
  const Spread turned = spread_of(opposite, {1.0, 0.0, 0.004});
  EXPECT_NEAR(turned.position / turned.position_believed, 1.0, 0.3);
}

TEST(GraphCovariance, CarriesARotationThatAllStepsShareThroughTheLoops) {
  const Spread rotated = spread_of(kLap / 2, {1.0, 0.0, 0.0, 0.0004});
  EXPECT_NEAR(rotated.position / rotated.position_believed, 1.0, 0.3);
  EXPECT_GT(rotated.position, 1.1 * spread_of(kLap / 2, {}).position) << "the test is blunt";
}

TEST(GraphCovariance, LoopsMakeSurer) {
  std::mt19937 random(3);
  const Drive drive({}, random);
  const ClosedGraph closed = optimise_pose_graph(drive.keyframes, drive.loops);
  const ClosedGraph open = optimise_pose_graph(drive.keyframes, {});
  const auto with = closed_covariances(drive.keyframes, closed, {});
  const auto without = closed_covariances(drive.keyframes, open, {});
  EXPECT_TRUE(with.front().isZero());
  EXPECT_LT(with.back().trace(), 0.5 * without.back().trace());
  for (const Matrix6& one : with) {
    EXPECT_GE(Eigen::SelfAdjointEigenSolver<Matrix6>(one).eigenvalues().minCoeff(), -1e-12);
  }
}

TEST(GraphCovariance, IsZeroOfADriveOfOneKeyframeAndOfNone) {
  EXPECT_TRUE(closed_covariances({}, optimise_pose_graph({}, {}), {}).empty());
  std::mt19937 random(3);
  std::vector<LoopKeyframe> one = Drive({}, random).keyframes;
  one.resize(1);
  const auto sure = closed_covariances(one, optimise_pose_graph(one, {}), {});
  ASSERT_EQ(sure.size(), 1U);
  EXPECT_TRUE(sure.front().isZero());
}

}  // namespace
}  // namespace oneac
