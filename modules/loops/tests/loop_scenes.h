#pragma once

#include "chain.h"
#include "landmark_pose.h"

#include "oneac/geometry/angles.h"
#include "oneac/loops/loop_constraint.h"
#include "oneac/loops/loop_keyframe.h"

#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace oneac::test {

inline Eigen::Isometry3d pose_at(double x, double z, double yaw_deg) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(yaw_deg * kDegree, Eigen::Vector3d::UnitY()).toRotationMatrix();
  T.translation() = Eigen::Vector3d(x, 0.0, z);
  return T;
}

/// Of a step: 1σ of 2 cm and of 0.1 degrees.
inline Eigen::Matrix<double, 6, 6> step_covariance() {
  constexpr double kPosition = 0.02, kTurn = 0.1 * kDegree;
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  covariance.diagonal().head<3>().setConstant(kPosition * kPosition);
  covariance.diagonal().tail<3>().setConstant(kTurn * kTurn);
  return covariance;
}

/// The truth of a drive round a square of `side` metres, keyframes 2 m apart, `laps` times.
inline std::vector<Eigen::Isometry3d> square_drive(double side, int laps) {
  std::vector<Eigen::Isometry3d> poses;
  const int steps = static_cast<int>(side / 2.0);
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (int street = 0; street < 4 * laps; ++street) {
    for (int i = 0; i < steps; ++i) {
      poses.push_back(T);
      T = T * pose_at(0.0, 2.0, i + 1 == steps ? 90.0 : 0.0);
    }
  }
  return poses;
}

/// What odometry that turns too much by `yaw_deg` in every step makes of a drive.
inline std::vector<LoopKeyframe> drifted(const std::vector<Eigen::Isometry3d>& truth,
                                         double yaw_deg) {
  std::vector<LoopKeyframe> keyframes;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (i > 0) T = T * truth[i - 1].inverse() * truth[i] * pose_at(0.0, 0.0, yaw_deg);
    LoopKeyframe keyframe;
    keyframe.id = keyframe.index = i;
    keyframe.time_s = static_cast<double>(i);
    keyframe.metric = true;
    keyframe.T_first_cam = T;
    if (i > 0) keyframe.covariance = step_covariance();
    keyframe.scale_sigma = 0.01;
    keyframes.push_back(keyframe);
  }
  return keyframes;
}

inline internal::Chain chain_of(const std::vector<LoopKeyframe>& keyframes) {
  internal::Chain chain;
  for (const LoopKeyframe& keyframe : keyframes) chain.add(keyframe);
  return chain;
}

/// T_2_1 of two poses, with 1σ of 3 cm and 0.1 degrees; `shift` is added in the second's frame.
inline LoopConstraint loop_between(const std::vector<Eigen::Isometry3d>& truth, std::size_t first,
                                   std::size_t second,
                                   const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) {
  const Eigen::Isometry3d T = truth[second].inverse() * truth[first];
  LoopConstraint loop;
  loop.first = first;
  loop.second = second;
  loop.T_2_1 = {T.linear(), T.translation() + shift};
  constexpr double kPosition = 0.03, kTurn = 0.1 * kDegree;
  loop.covariance.diagonal().head<3>().setConstant(kTurn * kTurn);
  loop.covariance.diagonal().tail<3>().setConstant(kPosition * kPosition);
  loop.sigma_length = kPosition;
  loop.inliers = 50;
  loop.acs = 80;
  return loop;
}

/// Points 4 to 40 m ahead, seen by both views; each is a landmark of the one, then of the other.
inline std::vector<internal::LandmarkSight> landmark_sights(std::mt19937& generator, int count,
                                                            const RelativePose& T_2_1, double noise,
                                                            double depth_noise) {
  std::uniform_real_distribution<double> across(-0.5, 0.5), depth(4.0, 40.0);
  std::normal_distribution<double> normal;
  const auto seen = [&](const Eigen::Vector3d& X) -> Eigen::Vector2d {
    return X.head<2>() / X.z() + noise * Eigen::Vector2d(normal(generator), normal(generator));
  };
  std::vector<internal::LandmarkSight> sights;
  for (int i = 0; i < count; ++i) {
    const bool of_first = i % 2 == 0;
    const RelativePose T = of_first ? T_2_1 : T_2_1.inverse();
    const double z = depth(generator);
    const Eigen::Vector3d X = z * Eigen::Vector3d(across(generator), across(generator), 1.0);
    internal::LandmarkSight sight;
    sight.x = X.head<2>() / z;
    sight.inverse_depth = (1.0 + depth_noise * normal(generator)) / z;
    sight.inverse_depth_sigma = depth_noise / z;
    sight.other = seen(T * X);
    sight.of_first = of_first;
    sights.push_back(sight);
  }
  return sights;
}

}  // namespace oneac::test
