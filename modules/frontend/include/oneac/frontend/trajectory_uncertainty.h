#pragma once

#include "oneac/frontend/frame_result.h"

#include <Eigen/Core>

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
/// Errors of turn and direction are independent from step to step, and all turns share an error of
/// their scale, that of the focal length. The relative error of length has
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

/// Relative 1σ that all turns of a drive share, for the doubt of its camera.
[[nodiscard]] double shared_turn_sigma(double camera_doubt);

/// Of the positions alone [m²].
[[nodiscard]] std::vector<Eigen::Matrix3d> position_covariances(
    const std::vector<FrameResult>& frames, double common_sigma, double camera_doubt = 0.0);

}  // namespace oneac
