#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <filesystem>
#include <vector>

namespace oneac {

/// Edge of a pose graph in a file: T_a_b as measured.
struct G2oEdge {
  std::size_t a = 0, b = 0;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  /// Of translation and vector part of the quaternion, on the right.
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Identity();
};

struct G2oGraph {
  std::vector<Eigen::Isometry3d> vertices;  ///< numbered from 0 without a gap
  std::vector<G2oEdge> edges;
};

/// VERTEX_SE3:QUAT and EDGE_SE3:QUAT of a file, as g2o defines them; other lines fail the test.
[[nodiscard]] G2oGraph read_g2o(const std::filesystem::path& path);

/// What makes the edges fit best, the first vertex as it is: Gauss-Newton with numeric Jacobians,
/// written without a look at the program's own solver.
[[nodiscard]] std::vector<Eigen::Isometry3d> least_squares(const G2oGraph& graph);

}  // namespace oneac
