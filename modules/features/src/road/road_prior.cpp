#include "road_prior.h"

#include "oneac/geometry/relative_pose.h"
#include "oneac/geometry/tangent_basis.h"

#include <Eigen/Cholesky>

#include <algorithm>

namespace oneac::internal {
namespace {

constexpr double kUnknownSigma = 0.2;  // [rad] of a motion about which nothing is said
// [rad] a road is no plane: its slope over ten metres differs so much from that under the car
// (KITTI 03: with 0.1° a quarter of the lengths are beyond two of their sigmas, with 0.3° a ninth).
constexpr double kLeastPitchSigma = 0.006;

using Matrix5d = Eigen::Matrix<double, 5, 5>;
using Matrix65d = Eigen::Matrix<double, 6, 5>;

/// Covariance of (w, direction in its tangent plane B) of T_2_1, with floors.
Matrix5d motion_covariance(const RoadStep& step, const Eigen::Matrix<double, 3, 2>& B,
                           const RoadAlignmentOptions& options) {
  Matrix65d Q = Matrix65d::Zero();
  Q.topLeftCorner<3, 3>().setIdentity();
  Q.bottomRightCorner<3, 2>() = B;
  Matrix5d information = Q.transpose() * step.information * Q;
  information += Matrix5d::Identity() / (kUnknownSigma * kUnknownSigma);
  Matrix5d covariance = information.ldlt().solve(Matrix5d::Identity());
  const double turn = options.min_rotation_sigma, travel = options.min_direction_sigma;
  covariance.diagonal().head<3>().array() += turn * turn;
  covariance.diagonal().tail<2>().array() += travel * travel;
  return covariance;
}

/// The same of RoadMotion's rotation and direction.
Matrix5d in_view_b(const Matrix5d& covariance, const Eigen::Matrix3d& R,
                   const Eigen::Vector3d& direction, const Eigen::Matrix<double, 3, 2>& B,
                   bool forward) {
  Matrix5d map = Matrix5d::Identity();
  if (forward) {
    map.topLeftCorner<3, 3>() = R.transpose();
  } else {
    map = -map;
    map.bottomLeftCorner<2, 3>() = -B.transpose() * cross_matrix(direction);
  }
  return map * covariance * map.transpose();
}

}  // namespace

RoadPrior make_prior(const RoadStep& step, bool forward, const Eigen::Vector3d& direction,
                     const RoadAlignmentOptions& options) {
  const Eigen::Matrix3d& R = step.T_2_1.R;
  const Eigen::Matrix<double, 3, 2> B = tangent_basis(direction);
  const Eigen::Matrix3d R_b_1 = forward ? Eigen::Matrix3d::Identity() : R;
  const Eigen::Matrix3d R_b_level = R_b_1 * step.R_level_cam.transpose();
  RoadPrior prior;
  prior.start.R_b_a = forward ? Eigen::Matrix3d(R.transpose()) : R;
  prior.start.s = forward ? Eigen::Vector3d(R.transpose() * direction) : -direction;
  prior.start.n = R_b_level.col(1);
  prior.tangents.normal << R_b_level.col(2), R_b_level.col(0);
  prior.tangents.travel = forward ? Eigen::Matrix<double, 3, 2>(R.transpose() * B) : B;
  prior.heave = options.heave;
  const double pitch_sigma = std::max(step.pitch_sigma, kLeastPitchSigma);
  prior.information(1, 1) = 1.0 / (pitch_sigma * pitch_sigma);
  prior.information(2, 2) = 1.0 / (step.roll_sigma * step.roll_sigma);
  const Matrix5d covariance =
      in_view_b(motion_covariance(step, B, options), R, direction, B, forward);
  prior.information.bottomRightCorner<5, 5>() = covariance.ldlt().solve(Matrix5d::Identity());
  return prior;
}

}  // namespace oneac::internal
