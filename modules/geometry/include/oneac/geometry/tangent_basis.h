#pragma once

#include <Eigen/Core>

namespace oneac {

/// An orthonormal basis of the plane perpendicular to the unit vector t, continuous in t but for a
/// switch of axis.
[[nodiscard]] Eigen::Matrix<double, 3, 2> tangent_basis(const Eigen::Vector3d& t);

}  // namespace oneac
