#include "g2o_solution.h"

#include <gtest/gtest.h>

#include <Eigen/Sparse>

#include <fstream>
#include <sstream>
#include <string>

namespace oneac {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Blocks = Eigen::Matrix<double, 6, 12>;

Eigen::Isometry3d read_pose(std::istream& in) {
  Eigen::Vector3d t;
  Eigen::Quaterniond q;
  in >> t.x() >> t.y() >> t.z() >> q.x() >> q.y() >> q.z() >> q.w();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = q.normalized().toRotationMatrix();
  T.translation() = t;
  return T;
}

G2oEdge read_edge(std::istream& in) {
  G2oEdge edge;
  in >> edge.a >> edge.b;
  edge.T = read_pose(in);
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      in >> edge.information(row, column);
      edge.information(column, row) = edge.information(row, column);
    }
  }
  return edge;
}

/// Translation and vector part of the quaternion.
Vector6 coordinates(const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond q(T.linear());
  Vector6 all;
  all << T.translation(), (q.w() < 0.0 ? -1.0 : 1.0) * q.vec();
  return all;
}

Eigen::Isometry3d moved(const Eigen::Isometry3d& T, const Vector6& by) {
  const Eigen::Vector3d half = by.tail<3>();
  Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
  step.linear() =
      Eigen::Quaterniond(1.0, half.x(), half.y(), half.z()).normalized().toRotationMatrix();
  step.translation() = by.head<3>();
  return T * step;
}

Vector6 error_of(const G2oEdge& edge, const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return coordinates(edge.T.inverse() * a.inverse() * b);
}

Blocks jacobian_of(const G2oEdge& edge, const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  constexpr double kStep = 1e-6;
  Blocks J;
  for (int k = 0; k < 6; ++k) {
    const Vector6 step = kStep * Vector6::Unit(k);
    J.col(k) = error_of(edge, moved(a, step), b) - error_of(edge, moved(a, -step), b);
    J.col(6 + k) = error_of(edge, a, moved(b, step)) - error_of(edge, a, moved(b, -step));
  }
  return J / (2.0 * kStep);
}

/// Normal equations of all vertices but the first, which stays.
class NormalEquations {
 public:
  explicit NormalEquations(std::size_t vertices) : g_(6 * static_cast<int>(vertices)) {
    g_.setZero();
    for (int i = 0; i < 6; ++i) entries_.emplace_back(i, i, 1.0);
  }

  void add(const G2oEdge& edge, const Vector6& error, const Blocks& J) {
    const Eigen::Matrix<double, 12, 12> H = J.transpose() * edge.information * J;
    const Eigen::Matrix<double, 12, 1> g = J.transpose() * edge.information * error;
    const std::size_t ends[] = {edge.a, edge.b};
    for (int i = 0; i < 12; ++i) {
      if (ends[i / 6] == 0) continue;
      g_[at(ends[i / 6], i)] += g[i];
      for (int j = 0; j < 12; ++j) {
        if (ends[j / 6] == 0) continue;
        entries_.emplace_back(at(ends[i / 6], i), at(ends[j / 6], j), H(i, j));
      }
    }
  }

  [[nodiscard]] Eigen::VectorXd step() const {
    Eigen::SparseMatrix<double> H(g_.size(), g_.size());
    H.setFromTriplets(entries_.begin(), entries_.end());
    return -Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(H).solve(g_);
  }

 private:
  static int at(std::size_t vertex, int i) { return 6 * static_cast<int>(vertex) + i % 6; }

  Eigen::VectorXd g_;
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace

G2oGraph read_g2o(const std::filesystem::path& path) {
  G2oGraph graph;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream in(line);
    std::string key;
    std::size_t id = 0;
    if (in >> key; key == "EDGE_SE3:QUAT") {
      graph.edges.push_back(read_edge(in));
    } else {
      EXPECT_EQ(key, "VERTEX_SE3:QUAT") << line;
      in >> id;
      EXPECT_EQ(id, graph.vertices.size()) << line;
      graph.vertices.push_back(read_pose(in));
    }
    EXPECT_FALSE(in.fail()) << line;
  }
  return graph;
}

std::vector<Eigen::Isometry3d> least_squares(const G2oGraph& graph) {
  constexpr int kIterations = 30;
  std::vector<Eigen::Isometry3d> poses = graph.vertices;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    NormalEquations equations(poses.size());
    for (const G2oEdge& edge : graph.edges) {
      const Eigen::Isometry3d &a = poses.at(edge.a), &b = poses.at(edge.b);
      equations.add(edge, error_of(edge, a, b), jacobian_of(edge, a, b));
    }
    const Eigen::VectorXd step = equations.step();
    for (std::size_t i = 0; i < poses.size(); ++i) {
      poses[i] = moved(poses[i], step.segment<6>(6 * static_cast<int>(i)));
    }
  }
  return poses;
}

}  // namespace oneac
