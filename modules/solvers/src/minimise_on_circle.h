#pragma once

#include <Eigen/Core>

namespace oneac::internal {

/// x = argmin xᵀ Q x − 2 hᵀ x on the unit circle, Q symmetric positive semidefinite.
[[nodiscard]] Eigen::Vector2d minimise_on_circle(const Eigen::Matrix2d& Q,
                                                 const Eigen::Vector2d& h);

}  // namespace oneac::internal
