#pragma once

#include <Eigen/Geometry>

#include <array>
#include <string>

namespace oneac::internal {

/// Upper three rows of T_world_body, row by row; made orthonormal.
/// @throws InputError naming `where` when the columns are no rotation
[[nodiscard]] Eigen::Isometry3d pose_of_matrix(const std::array<double, 12>& v,
                                               const std::string& where);

/// @param v  x y z qx qy qz qw
/// @throws InputError naming `where` when the quaternion has not the length 1
[[nodiscard]] Eigen::Isometry3d pose_of_quaternion(const std::array<double, 7>& v,
                                                   const std::string& where);

}  // namespace oneac::internal
