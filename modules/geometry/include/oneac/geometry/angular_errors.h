#pragma once

#include <Eigen/Core>

namespace oneac {

/// ξ_R = acos((tr(R_est R_refᵀ) − 1) / 2) [rad], accurate near zero   [Gal 2020, section 4].
[[nodiscard]] double rotation_error(const Eigen::Matrix3d& R_est, const Eigen::Matrix3d& R_ref);

/// ξ_t: angle between two directions [rad], 0…π; the sign counts. π/2 when either has no length.
[[nodiscard]] double direction_error(const Eigen::Vector3d& t_est, const Eigen::Vector3d& t_ref);

/// ξ_n: angle between two plane normals [rad], 0…π/2; a normal and its opposite are the same.
[[nodiscard]] double normal_error(const Eigen::Vector3d& n_est, const Eigen::Vector3d& n_ref);

}  // namespace oneac
