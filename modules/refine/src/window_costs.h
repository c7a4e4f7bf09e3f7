#pragma once

#include "oneac/refine/sliding_window.h"

#include <ceres/manifold.h>
#include <ceres/sized_cost_function.h>

#include <Eigen/Core>

namespace oneac {

/// A pose block: quaternion (x, y, z, w), then t. Numbers are copied in and out: no Eigen type with
/// alignment lies in memory that Ceres sees.
using PoseBlock = double[7];
void store_pose(const RelativePose& pose, double* block);
[[nodiscard]] RelativePose load_pose(const double* block);

/// R ← exp([w]×) R, t ← t + v. The costs give their derivatives with respect to (w, v) in the first
/// six of the seven columns; the plus-Jacobian picks them.
class PoseManifold final : public ceres::Manifold {
 public:
  [[nodiscard]] int AmbientSize() const override { return 7; }
  [[nodiscard]] int TangentSize() const override { return 6; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;
};

/// Reprojection of a landmark (x, y, ρ[, g]) in standard deviations. Blocks: anchor pose, view
/// pose, landmark of 3 or 5 numbers.
template <int LandmarkSize>
class ReprojectionCost final : public ceres::SizedCostFunction<2, 7, 7, LandmarkSize> {
 public:
  ReprojectionCost(const Eigen::Vector2d& x, double sigma) : u_(x.x()), v_(x.y()), sigma_(sigma) {}
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override;

 private:
  double u_, v_, sigma_;
};

/// Affinity from the anchor, column by column, in standard deviations. Blocks as above.
class AffinityCost final : public ceres::SizedCostFunction<4, 7, 7, 5> {
 public:
  AffinityCost(const Eigen::Matrix2d& A, double sigma);
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override;

 private:
  double a_[4], sigma_;
};

/// The anchor's own measurement of the ray. Block: landmark.
template <int LandmarkSize>
class AnchorCost final : public ceres::SizedCostFunction<2, LandmarkSize> {
 public:
  AnchorCost(const Eigen::Vector2d& x, double sigma) : u_(x.x()), v_(x.y()), sigma_(sigma) {}
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override;

 private:
  double u_, v_, sigma_;
};

/// How planar the motion between two views is: elevation of the travel, relative pitch and roll.
struct PlanarPrior {
  double down[3];         ///< gravity in the camera
  double right[3];        ///< the levelled X axis in the camera
  double ahead[3];        ///< the levelled Z axis
  double sigma_travel;    ///< [length] of the vertical part of the travel
  double sigma_rotation;  ///< [rad]
};

/// What it says about two poses.
[[nodiscard]] Eigen::Vector3d planar_residuals(const PlanarPrior& prior, const RelativePose& first,
                                               const RelativePose& second);
/// ∂(residuals)/∂(w, v) of both poses.
struct PlanarDerivative {
  Eigen::Matrix<double, 3, 6> first, second;
};
[[nodiscard]] PlanarDerivative planar_derivative(const PlanarPrior& prior,
                                                 const RelativePose& first,
                                                 const RelativePose& second);

/// Residuals of the prior. Blocks: first and second pose.
class PlanarMotionCost final : public ceres::SizedCostFunction<3, 7, 7> {
 public:
  explicit PlanarMotionCost(const PlanarPrior& prior) : prior_(prior) {}
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override;

 private:
  PlanarPrior prior_;
};

extern template class ReprojectionCost<3>;
extern template class ReprojectionCost<5>;
extern template class AnchorCost<3>;
extern template class AnchorCost<5>;

}  // namespace oneac
