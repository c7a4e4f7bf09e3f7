#include "oneac/frontend/trajectory_uncertainty.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

// [m] way over which the map's own error of scale lasts: near landmarks stay in view for so long.
constexpr double kScaleMemory = 20.0;
constexpr double kUnknownLength = 1.0;  // relative 1σ of a length that is not metric
// [-] 1σ of all turns together: a focal length that is wrong by as much makes them wrong by as
// much, and published calibrations have been seen two per cent off.
constexpr double kTurnScale = 0.01;
// [-] of a step's 1σ of rotation that all steps share: lens, shutter and mount pull the same way,
// and where laps repeat it leads a drive off like a screw. 0.18 to 0.27 of it were seen.
constexpr double kSharedRotation = 0.25;

/// The step's covariance for its length in the trajectory, without what is known along t.
Matrix6 beside_length(const StepResult& step, double length) {
  const double own = step.pose.t.norm();
  if (!(own > 0.0)) return step.covariance;
  Matrix6 covariance = step.covariance;
  const double factor = length / own;
  covariance.rightCols<3>() *= factor;
  covariance.bottomRows<3>() *= factor;
  const Eigen::Vector3d u = step.pose.t / own;
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - u * u.transpose();
  covariance.rightCols<3>() *= across;
  covariance.bottomRows<3>() = across * covariance.bottomRows<3>().eval();
  return covariance;
}

}  // namespace

PoseUncertainty::PoseUncertainty(double common_sigma, double camera_doubt)
    : common_sigma_(common_sigma), turn_scale_(shared_turn_sigma(camera_doubt)) {}

PoseUncertainty::Matrix6 PoseUncertainty::add(const FrameResult& frame) {
  if (before_ && frame.step) add_step(*frame.step, frame.T_first_cam);
  before_ = frame.T_first_cam;
  return pose();
}

void PoseUncertainty::add_step(const StepResult& step, const Eigen::Isometry3d& now) {
  const Eigen::Vector3d d = now.translation() - before_->translation();
  add_turns(step, d, now.linear());
  const Eigen::AngleAxisd turn(now.linear() * before_->linear().transpose());
  turned_ += turn_scale_ * turn.angle() * turn.axis();
  by_turns_ += turned_.cross(d);
  const Eigen::Vector3d shared = shared_rotation_sigma(step);
  for (int axis = 0; axis < 3; ++axis) {
    rotated_.col(axis) += shared[axis] * now.linear().col(axis);
    by_rotation_.col(axis) += rotated_.col(axis).cross(d);
  }
  if (step.pose.t.norm() > 0.0) add_length(step, d);
}

// Errors so far: independent ones, two of length, one of all turns together, and one of rotation
// about each axis of the camera.
PoseUncertainty::Matrix6 PoseUncertainty::pose() const {
  Eigen::Matrix<double, 6, 1> by_scale_of_turns;
  by_scale_of_turns << turned_, by_turns_;
  Matrix6 all = turns_ + by_scale_of_turns * by_scale_of_turns.transpose();
  Eigen::Matrix<double, 6, 3> by_rotation;
  by_rotation << rotated_, by_rotation_;
  all += by_rotation * by_rotation.transpose();
  all.bottomRightCorner<3, 3>() += common_ * common_.transpose() + lengths_;
  return 0.5 * (all + all.transpose());
}

void PoseUncertainty::add_turns(const StepResult& step, const Eigen::Vector3d& d,
                                const Eigen::Matrix3d& R) {
  Matrix6 carried = Matrix6::Identity(), from_step = Matrix6::Zero();
  carried.bottomLeftCorner<3, 3>() = -cross_matrix(d);
  from_step.topLeftCorner<3, 3>() = -R;
  from_step.bottomLeftCorner<3, 3>() = -R * cross_matrix(-R.transpose() * d);
  from_step.bottomRightCorner<3, 3>() = -R;
  turns_ = carried * turns_ * carried.transpose() +
           from_step * beside_length(step, d.norm()) * from_step.transpose();
}

// e' = kept e + …, p' = p + σ d e' with a remembered error e of unit variance.
void PoseUncertainty::add_length(const StepResult& step, const Eigen::Vector3d& d) {
  const double sigma = step.metric ? step.length_sigma : kUnknownLength;
  const double shared = std::min(sigma, common_sigma_);
  common_ += shared * d;
  const Eigen::Vector3d rest = std::sqrt(sigma * sigma - shared * shared) * d;
  with_length_ *= std::exp(-d.norm() / kScaleMemory);
  lengths_ +=
      rest * with_length_.transpose() + with_length_ * rest.transpose() + rest * rest.transpose();
  with_length_ += rest;
}

Eigen::Vector3d shared_rotation_sigma(const StepResult& step) {
  return kSharedRotation * step.covariance.diagonal().head<3>().cwiseMax(0.0).cwiseSqrt();
}

double shared_turn_sigma(double camera_doubt) {
  return std::max(kTurnScale, camera_doubt);
}

std::optional<double> sigma_of_length(const StepResult& step) {
  if (!step.metric) return std::nullopt;
  const Eigen::Matrix3d of_t = step.covariance.bottomRightCorner<3, 3>();
  const double length = step.pose.t.norm();
  const double variance =
      length > 0.0 ? step.pose.t.dot(of_t * step.pose.t) / (length * length) : of_t.trace() / 3.0;
  return std::sqrt(std::max(variance, 0.0));
}

std::vector<Matrix6> pose_covariances(const std::vector<FrameResult>& frames, double common_sigma,
                                      double camera_doubt) {
  std::vector<Matrix6> covariances;
  covariances.reserve(frames.size());
  PoseUncertainty chain(common_sigma, camera_doubt);
  for (const FrameResult& frame : frames) covariances.push_back(chain.add(frame));
  return covariances;
}

std::vector<Eigen::Matrix3d> position_covariances(const std::vector<FrameResult>& frames,
                                                  double common_sigma, double camera_doubt) {
  std::vector<Eigen::Matrix3d> covariances;
  for (const Matrix6& pose : pose_covariances(frames, common_sigma, camera_doubt)) {
    covariances.emplace_back(pose.bottomRightCorner<3, 3>());
  }
  return covariances;
}

}  // namespace oneac
