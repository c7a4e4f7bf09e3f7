#include "uncertainty/step_covariance.h"

#include "oneac/frontend/step_metres.h"
#include "oneac/frontend/trajectory_uncertainty.h"
#include "oneac/geometry/tangent_basis.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>
#include <random>

namespace oneac {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

double smallest_eigenvalue(const Eigen::MatrixXd& m) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m).eigenvalues().minCoeff();
}

/// Of (w, v) with v ⊥ t, as two views give it.
Matrix6 of_direction(const Eigen::Vector3d& t, double turn, double direction) {
  Eigen::Matrix<double, 6, 5> basis = Eigen::Matrix<double, 6, 5>::Zero();
  basis.topLeftCorner<3, 3>().setIdentity();
  basis.bottomRightCorner<3, 2>() = tangent_basis(t.normalized());
  Eigen::Matrix<double, 5, 5> covariance = Eigen::Matrix<double, 5, 5>::Identity();
  covariance.topLeftCorner<3, 3>() *= turn * turn;
  covariance.bottomRightCorner<2, 2>() *= direction * direction;
  covariance(0, 3) = covariance(3, 0) = 0.6 * turn * direction;
  return basis * covariance * basis.transpose();
}

StepResult metric_step(const Eigen::Vector3d& t, double length_sigma) {
  StepResult step;
  step.status = StepStatus::kOk;
  step.pose.t = t;
  step.metric = true;
  step.length = t.norm();
  step.length_sigma = length_sigma;
  step.covariance = step_covariance(step, of_direction(t, 1e-3, 4e-3));
  return step;
}

/// A drive straight ahead, a step per frame.
std::vector<FrameResult> straight_drive(std::size_t steps, const StepResult& step) {
  std::vector<FrameResult> frames(1);
  for (std::size_t i = 0; i < steps; ++i) {
    FrameResult next;
    next.T_first_cam = frames.back().T_first_cam;
    next.T_first_cam.translation() -= step.pose.t;
    next.step = step;
    frames.push_back(next);
  }
  return frames;
}

TEST(DoubtMetres, StatesTheDoubtInStepsBeforeItWasTold) {
  StepResult step = metric_step({0.1, 0.05, -1.4}, 0.03);
  const Matrix6 before = step.covariance;
  doubt_metres(step, 0.04, 0.06);
  EXPECT_TRUE(step.metric);
  EXPECT_NEAR(step.length_sigma, 0.05, 1e-12);
  EXPECT_NEAR(*sigma_of_length(step), 0.05 * step.pose.t.norm(), 1e-9);
  doubt_metres(step, 0.04, 0.06);
  EXPECT_NEAR(step.length_sigma, 0.05, 1e-12) << "once";
  doubt_metres(step, 0.0, 0.06);
  EXPECT_NEAR(step.length_sigma, 0.03, 1e-12);
  EXPECT_TRUE(step.covariance.isApprox(before, 1e-9)) << "taken back";
}

TEST(DoubtMetres, ALengthThatIsTooUnsureIsNotMetric) {
  StepResult step = metric_step({0.0, 0.0, -1.4}, 0.03);
  doubt_metres(step, 0.07, 0.06);
  EXPECT_FALSE(step.metric);
  EXPECT_NEAR(step.pose.t.norm(), 1.0, 1e-12);
  EXPECT_EQ(step.length_sigma, 0.0);
  EXPECT_GT(smallest_eigenvalue(step.covariance), -1e-12);
  StepResult moving_off = metric_step({0.0, 0.0, -0.013}, 0.08);
  doubt_metres(moving_off, 0.01, 0.06);
  EXPECT_TRUE(moving_off.metric) << "a millimetre of a creep of centimetres";
  StepResult rest;
  rest.status = StepStatus::kNoMotion;
  rest.metric = true;
  doubt_metres(rest, 0.07, 0.06);
  EXPECT_TRUE(rest.metric) << "zero is zero in any unit";
}

TEST(StepCovariance, AddsTheLengthAlongTheWay) {
  const Eigen::Vector3d t(0.1, 0.05, -1.4);
  const StepResult step = metric_step(t, 0.03);
  const Eigen::Vector3d u = t.normalized();
  const Eigen::Matrix3d of_t = step.covariance.bottomRightCorner<3, 3>();
  EXPECT_NEAR(u.dot(of_t * u), std::pow(0.03 * t.norm(), 2), 1e-15);
  // Tracks share their errors: four times the variance of independent ones, and a floor.
  const double direction = std::sqrt(4.0 * std::pow(4e-3, 2) + std::pow(1e-3, 2));
  EXPECT_NEAR(of_t.trace() - u.dot(of_t * u), 2.0 * std::pow(direction * t.norm(), 2), 1e-15);
  ASSERT_TRUE(sigma_of_length(step).has_value());
  EXPECT_NEAR(*sigma_of_length(step), 0.03 * t.norm(), 1e-12);
}

TEST(StepCovariance, ScalesWhatTurnAndDirectionShare) {
  const Eigen::Vector3d t(0.0, 0.0, -2.0);
  const Matrix6 seen = of_direction(t, 1e-3, 4e-3);
  const StepResult step = metric_step(t, 0.0);
  EXPECT_TRUE((step.covariance.topRightCorner<3, 3>())
                  .isApprox(4.0 * 2.0 * seen.topRightCorner<3, 3>(), 1e-12));
}

TEST(StepCovariance, IsSymmetricAndPositiveSemidefiniteForEveryKindOfStep) {
  StepResult step = metric_step({0.2, -0.1, -1.0}, 0.02);
  const Matrix6 seen = of_direction(step.pose.t, 1e-3, 4e-3);
  for (const StepStatus status : {StepStatus::kOk, StepStatus::kNoMotion, StepStatus::kPredicted}) {
    for (const Matrix6& told : {seen, Matrix6(Matrix6::Zero())}) {
      step.status = status;
      const Matrix6 covariance = step_covariance(step, told);
      EXPECT_TRUE(covariance.isApprox(covariance.transpose(), 1e-14));
      EXPECT_GT(smallest_eigenvalue(covariance), -1e-15) << to_string(status);
      EXPECT_GT((covariance.topLeftCorner<3, 3>().trace()), 0.0) << to_string(status);
    }
  }
}

TEST(StepCovariance, WithoutMetresSaysNothingAlongTheDirection) {
  StepResult step;
  step.status = StepStatus::kOk;
  step.pose.t = Eigen::Vector3d(0.6, 0.0, -0.8);
  const Matrix6 covariance = step_covariance(step, of_direction(step.pose.t, 1e-3, 4e-3));
  EXPECT_NEAR((covariance.bottomRows<3>().transpose() * step.pose.t).norm(), 0.0, 1e-15);
  step.covariance = covariance;
  EXPECT_FALSE(sigma_of_length(step).has_value());
}

TEST(StepCovariance, StandingIsAMeasurementWithASigma) {
  StepResult step;
  step.status = StepStatus::kNoMotion;
  step.metric = true;
  step.covariance = step_covariance(step, Matrix6::Zero());
  ASSERT_TRUE(sigma_of_length(step).has_value());
  EXPECT_NEAR(*sigma_of_length(step), 0.01, 1e-12);
}

TEST(PositionCovariances, StayPositiveSemidefiniteAndGrow) {
  const auto covariances =
      position_covariances(straight_drive(300, metric_step({0.05, 0.0, -1.2}, 0.03)), 0.02);
  ASSERT_EQ(covariances.size(), 301U);
  EXPECT_TRUE(covariances.front().isZero(0.0));
  for (std::size_t i = 1; i < covariances.size(); ++i) {
    EXPECT_TRUE(covariances[i].isApprox(covariances[i].transpose(), 1e-12));
    EXPECT_GT(smallest_eigenvalue(covariances[i]), -1e-12);
    EXPECT_GT(covariances[i].trace(), covariances[i - 1].trace());
  }
}

TEST(PositionCovariances, AnErrorThatAllStepsShareGrowsWithTheWay) {
  StepResult step = metric_step({0.0, 0.0, -1.0}, 0.02);
  step.covariance.setZero();
  const auto covariances = position_covariances(straight_drive(100, step), 0.02);
  EXPECT_NEAR(std::sqrt(covariances.back()(2, 2)), 2.0, 1e-9);
}

TEST(PositionCovariances, TheRestIsForgottenAlongTheWay) {
  StepResult step = metric_step({0.0, 0.0, -1.0}, 0.02);
  step.covariance.setZero();
  const auto covariances = position_covariances(straight_drive(400, step), 0.0);
  const double first = std::sqrt(covariances[4](2, 2)), last = std::sqrt(covariances.back()(2, 2));
  EXPECT_NEAR(first, 0.08, 0.01);  // nearly as if shared
  EXPECT_LT(last, 0.4 * 8.0);      // far less than if shared ...
  EXPECT_GT(last, 2.0 * 0.4);      // ... and more than if independent
}

TEST(PositionCovariances, ACameraInDoubtIsUnsureOfItsTurns) {
  const StepResult straight = metric_step({0.0, 0.0, -1.0}, 0.03);
  std::vector<FrameResult> bend(1);
  const Eigen::AngleAxisd turn(0.05, Eigen::Vector3d::UnitY());
  for (int i = 0; i < 30; ++i) {
    FrameResult next;
    next.T_first_cam = bend.back().T_first_cam * Eigen::Translation3d(0.0, 0.0, 1.0) * turn;
    next.step = straight;
    bend.push_back(next);
  }
  const double sure = position_covariances(bend, 0.02).back().trace();
  EXPECT_GT(position_covariances(bend, 0.02, 0.05).back().trace(), 1.5 * sure);
  EXPECT_EQ(position_covariances(bend, 0.02, 0.001).back().trace(), sure);
}

TEST(PositionCovariances, AScrewOfManyLapsIsNoSurprise) {
  // A quarter of the 1σ of rotation about the axis of the camera in every step: it climbs.
  constexpr double kTurn = 2e-4;
  const Eigen::AngleAxisd lap(2.0 * M_PI / 100.0, Eigen::Vector3d::UnitY());
  StepResult step = metric_step({0.0, 0.0, -1.0}, 0.03);
  step.covariance.setZero();
  step.covariance.topLeftCorner<3, 3>().diagonal().setConstant(kTurn * kTurn);
  std::vector<FrameResult> frames(1);
  Eigen::Isometry3d screw = Eigen::Isometry3d::Identity();
  for (int i = 0; i < 2000; ++i) {
    FrameResult next;
    next.step = step;
    next.T_first_cam = frames.back().T_first_cam * Eigen::Translation3d(0.0, 0.0, 1.0) * lap;
    frames.push_back(next);
    screw = screw * Eigen::Translation3d(0.0, 0.0, 1.0) * lap *
            Eigen::AngleAxisd(0.25 * kTurn, Eigen::Vector3d::UnitZ());
  }
  const double sigma = std::sqrt(position_covariances(frames, 0.0).back()(1, 1));
  const double climbed = std::abs(screw.translation().y());
  EXPECT_GT(climbed, 1.0);
  EXPECT_LT(climbed, 2.0 * sigma);
  EXPECT_GT(climbed, 0.5 * sigma) << "no more than needed";
}

TEST(PositionCovariances, AgreeWithChainsOfDisturbedSteps) {
  constexpr std::size_t kSteps = 20;
  constexpr int kTrials = 4000;
  constexpr double kTurn = 2e-3, kDirection = 5e-3;
  std::mt19937 draw(3);
  std::normal_distribution<double> normal;
  const RelativePose motion{Eigen::AngleAxisd(0.03, Eigen::Vector3d::UnitY()).toRotationMatrix(),
                            {0.1, 0.0, -1.0}};
  StepResult step;
  step.status = StepStatus::kOk;
  step.pose = motion;
  step.metric = true;
  Matrix6 seen = Matrix6::Zero();
  const Eigen::Vector3d u = motion.t.normalized();
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - u * u.transpose();
  seen.topLeftCorner<3, 3>().diagonal().setConstant(kTurn * kTurn);
  seen.bottomRightCorner<3, 3>() = kDirection * kDirection * across;
  step.covariance = seen;
  step.covariance.bottomRightCorner<3, 3>() *= motion.t.squaredNorm();
  std::vector<FrameResult> frames(1);
  for (std::size_t i = 0; i < kSteps; ++i) {
    FrameResult next;
    next.step = step;
    next.T_first_cam = frames.back().T_first_cam;
    next.T_first_cam.linear() *= motion.R.transpose();
    next.T_first_cam.translation() -= next.T_first_cam.linear() * motion.t;
    frames.push_back(next);
  }
  const auto gauss = [&](double sigma) {
    return Eigen::Vector3d(sigma * normal(draw), sigma * normal(draw), sigma * normal(draw));
  };
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  Matrix6 of_pose = Matrix6::Zero();
  for (int trial = 0; trial < kTrials; ++trial) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    const double scale_of_turns = 0.01 * normal(draw);
    const Eigen::AngleAxisd more(scale_of_turns * 0.03, Eigen::Vector3d::UnitY());
    const Eigen::Vector3d of_all = gauss(0.25 * kTurn);
    for (std::size_t i = 0; i < kSteps; ++i) {
      const Eigen::Vector3d w = of_all + gauss(kTurn);
      const Eigen::Matrix3d R = Eigen::AngleAxisd(w.norm(), w.normalized()) * more * motion.R;
      const Eigen::Vector3d t = motion.t + motion.t.norm() * across * gauss(kDirection);
      T.linear() *= R.transpose();
      T.translation() -= T.linear() * t;
    }
    const Eigen::Vector3d error = T.translation() - frames.back().T_first_cam.translation();
    scatter += error * error.transpose() / kTrials;
    const Eigen::AngleAxisd turned(T.linear() * frames.back().T_first_cam.linear().transpose());
    Eigen::Matrix<double, 6, 1> both;
    both << turned.angle() * turned.axis(), error;
    of_pose += both * both.transpose() / kTrials;
  }
  const Eigen::Matrix3d predicted = position_covariances(frames, 0.0).back();
  EXPECT_LT((scatter - predicted).norm(), 0.1 * predicted.norm()) << scatter << "\n\n" << predicted;
  const Matrix6 pose = pose_covariances(frames, 0.0).back();
  const auto off = [&](int row, int column) {  // [-] of a block of 3 by 3
    const Eigen::Matrix3d error = of_pose.block<3, 3>(row, column) - pose.block<3, 3>(row, column);
    return error.norm() /
           std::sqrt(pose.block<3, 3>(row, row).trace() * pose.block<3, 3>(column, column).trace());
  };
  EXPECT_LT(off(0, 0), 0.1) << of_pose << "\n\n" << pose;
  EXPECT_LT(off(0, 3), 0.1) << of_pose << "\n\n" << pose;
}

}  // namespace
}  // namespace oneac
