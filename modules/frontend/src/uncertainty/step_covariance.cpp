#include "uncertainty/step_covariance.h"

#include <algorithm>

namespace oneac {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Of a step that its images did not tell and that repeats the one before: a car changes its yaw
// rate by up to 0.5 rad/s² and its slip with it; over 0.1 s between frames and twice that.
constexpr double kInertiaTurn = 0.01;       // [rad]
constexpr double kInertiaDirection = 0.05;  // [rad]
// Of a step that was found standing: 1 cm moves what is 10 m away by a pixel, and five times that
// is never taken for standing.
constexpr double kStandingWay = 0.01;   // [m]
constexpr double kStandingTurn = 3e-4;  // [rad] a fifth of a pixel at 700 px of focal length

// Of what two views say of themselves: they count errors that cells of the image share, but tracks
// of a cell share more (overlapping patches), so that a hundred of them count as a quarter as many.
// Measured on simulated drives, whose rotations and directions were off by 1.6 to 2.7 of the 1σ of
// independent tracks: docs/benchmarks/sigma.md.
constexpr double kShared = 4.0;           // variance over that of independent tracks
constexpr double kLeastTurn = 1e-4;       // [rad]
constexpr double kLeastDirection = 1e-3;  // [rad]

constexpr double squared(double x) {
  return x * x;
}

Matrix6 of_turn_alone(double sigma) {
  Matrix6 covariance = Matrix6::Zero();
  covariance.topLeftCorner<3, 3>().diagonal().setConstant(squared(sigma));
  return covariance;
}

Matrix6 standing(const Matrix6& of_turn, double rest_sigma) {
  Matrix6 covariance = kShared * of_turn + of_turn_alone(kStandingTurn);
  covariance.rightCols<3>().setZero();
  covariance.bottomRows<3>().setZero();
  covariance.bottomRightCorner<3, 3>().diagonal().setConstant(
      squared(std::max(kStandingWay, rest_sigma)));
  return covariance;
}

/// Of (w, v), by two views.
Matrix6 seen(const Matrix6& independent, const Eigen::Vector3d& direction) {
  Matrix6 covariance = kShared * independent;
  covariance.topLeftCorner<3, 3>().diagonal().array() += squared(kLeastTurn);
  covariance.bottomRightCorner<3, 3>() +=
      squared(kLeastDirection) * (Eigen::Matrix3d::Identity() - direction * direction.transpose());
  return covariance;
}

/// Of (w, v), by inertia.
Matrix6 expected(const Eigen::Vector3d& direction) {
  Matrix6 covariance = of_turn_alone(kInertiaTurn);
  covariance.bottomRightCorner<3, 3>() =
      squared(kInertiaDirection) *
      (Eigen::Matrix3d::Identity() - direction * direction.transpose());
  return covariance;
}

}  // namespace

Matrix6 step_covariance(const StepResult& step, const Matrix6& of_direction, double rest_sigma) {
  const double length = step.pose.t.norm();
  if (step.status == StepStatus::kNoMotion || !(length > 0.0)) {
    return standing(of_direction, rest_sigma);
  }
  const Eigen::Vector3d direction = step.pose.t / length;
  const bool told = step.status == StepStatus::kOk && !of_direction.isZero(0.0);
  Matrix6 covariance = told ? seen(of_direction, direction) : expected(direction);
  covariance.rightCols<3>() *= length;
  covariance.bottomRows<3>() *= length;
  covariance.bottomRightCorner<3, 3>() +=
      squared(length * step.length_sigma) * direction * direction.transpose();
  return covariance;
}

}  // namespace oneac
