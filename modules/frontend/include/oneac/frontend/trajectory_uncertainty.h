#pragma once

#include "oneac/frontend/frame_result.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <optional>
#include <vector>

namespace oneac {

/// [m] 1σ of the step's length: along t, or of a camera found standing along any axis; empty where
/// the step is not metric.
[[nodiscard]] std::optional<double> sigma_of_length(const StepResult& step);

/// How sure the poses of a drive are, one covariance per frame of (θ, p) in the first camera's
/// frame, R ← exp([θ]×) R and p ← p + δp of T_first_cam [rad², rad m, m²], by first-order
/// propagation along the chain of its steps:
///   θ₂ = θ₁ − R₂ w,  p₂ = p₁ − [d]× θ₁ − R₂ (v + [t]× w),  d = p₂ − p₁, R₂ = R of T_first_cam.
/// Errors of turn and direction are independent from step to step, but for a quarter of the 1σ of
/// rotation about each axis of the camera, which is the same in all steps; and all turns share an
/// error of their scale, that of the focal length. The relative error of length has
/// two parts: one that all steps share (the camera's height is the same wrong one throughout), and
/// the rest, which the map carries on and forgets within some 20 m.
/// A step without metres is unknown by its own length.
/// Loops and the window make the real ones smaller.
/// @param frames         of a whole drive, settled poses
/// @param common_sigma   relative 1σ of length that all steps share: ScaleOptions::road_uncertainty
///                       for metres by height, wheel_uncertainty by wheels, else 0
/// @param camera_doubt   relative 1σ of the focal length for what bends say, CameraBelief::doubt:
///                       turns are wrong by as much, and by one per cent in any case
[[nodiscard]] std::vector<Eigen::Matrix<double, 6, 6>> pose_covariances(
    const std::vector<FrameResult>& frames, double common_sigma, double camera_doubt = 0.0);

/// The same one frame after the other, for drives that are in no vector.
class PoseUncertainty {
 public:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  /// @param common_sigma, camera_doubt  see pose_covariances()
  explicit PoseUncertainty(double common_sigma, double camera_doubt = 0.0);
  /// The drive's next frame. @return its covariance of (θ, p)
  [[nodiscard]] Matrix6 add(const FrameResult& frame);

 private:
  void add_turns(const StepResult& step, const Eigen::Vector3d& d, const Eigen::Matrix3d& R);
  void add_length(const StepResult& step, const Eigen::Vector3d& d);
  void add_step(const StepResult& step, const Eigen::Isometry3d& now);
  [[nodiscard]] Matrix6 pose() const;

  double common_sigma_, turn_scale_;
  std::optional<Eigen::Isometry3d> before_;                ///< T_first_cam of the frame before
  Eigen::Vector3d turned_ = Eigen::Vector3d::Zero();       ///< [rad] 1σ by the scale of turns ...
  Eigen::Vector3d by_turns_ = Eigen::Vector3d::Zero();     ///< ... and of p by it
  Eigen::Matrix3d rotated_ = Eigen::Matrix3d::Zero();      ///< [rad] 1σ by rotation that steps ...
  Eigen::Matrix3d by_rotation_ = Eigen::Matrix3d::Zero();  ///< ... share, per axis; and of p by it
  Matrix6 turns_ = Matrix6::Zero();                        ///< of (θ, p)
  Eigen::Vector3d common_ = Eigen::Vector3d::Zero();       ///< 1σ of the shared error
  Eigen::Matrix3d lengths_ = Eigen::Matrix3d::Zero();      ///< of p by the rest
  Eigen::Vector3d with_length_ = Eigen::Vector3d::Zero();  ///< covariance of p and e
};

/// [rad] 1σ, about the axes of the second camera, of what the step's rotation has wrong as all
/// steps of the drive have.
[[nodiscard]] Eigen::Vector3d shared_rotation_sigma(const StepResult& step);

/// Relative 1σ that all turns of a drive share, for the doubt of its camera.
[[nodiscard]] double shared_turn_sigma(double camera_doubt);

/// Of the positions alone [m²].
[[nodiscard]] std::vector<Eigen::Matrix3d> position_covariances(
    const std::vector<FrameResult>& frames, double common_sigma, double camera_doubt = 0.0);

}  // namespace oneac
