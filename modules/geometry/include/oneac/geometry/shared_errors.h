#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace oneac {

/// Gradients of a cost summed over cells of the image, to see what neighbours share: a shutter that
/// rolls, a lens, a light make all terms of a cell pull one way. A sum over independent terms has
/// the variance V of its terms, one over terms that share an error more. Source: Liang and Zeger,
/// Biometrika 73, 1986 (clusters).
template <int N>
class GradientsOfCells {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;
  using Matrix = Eigen::Matrix<double, N, N>;

  void reserve(std::size_t terms) { terms_.reserve(terms); }

  /// Adds a term's gradient, Jᵀ r by its weight. The cells part what the terms cover.
  /// @param x  where it lies in the image, any unit
  void add(const Eigen::Vector2d& x, const Vector& gradient) {
    terms_.push_back({x, gradient});
    box_.extend(x);
  }

  /// What the cells' squared gradients have beyond V, along each axis of both, as far as it counts:
  /// such errors reach beyond a cell. Positive semidefinite, in V's units.
  /// @param V  Σ g gᵀ over the terms
  [[nodiscard]] Matrix shared(const Matrix& V) const {
    Matrix of_cells = Matrix::Zero();
    for (const Vector& g : sums()) of_cells += g * g.transpose();
    const Eigen::LLT<Matrix> root(V);
    if (root.info() != Eigen::Success) return kReach * of_cells;
    const Matrix half = root.matrixL().solve(of_cells);
    const Matrix whitened = root.matrixL().solve(half.transpose());
    const Eigen::SelfAdjointEigenSolver<Matrix> axes(whitened);
    if (axes.info() != Eigen::Success) return kReach * of_cells;
    const Matrix unwhitened = Matrix(root.matrixL()) * axes.eigenvectors();
    const Vector beyond = kReach * (axes.eigenvalues().array() - 1.0).max(0.0);
    return unwhitened * beyond.asDiagonal() * unwhitened.transpose();
  }

 private:
  // Twenty-four cells tell a variance to a third; more would cut what is shared into pieces.
  static constexpr int kColumns = 6, kRows = 4;
  // [-] Measured, with shutters that roll for a tenth to a third of the frame's time:
  // docs/decisions/refine-two-view.md.
  static constexpr double kReach = 10.0;

  struct Term {
    Eigen::Vector2d x;
    Vector gradient;
  };
  using Sums = std::array<Vector, static_cast<std::size_t>(kColumns) * kRows>;

  [[nodiscard]] Sums sums() const {
    Sums sums;
    sums.fill(Vector::Zero());
    if (terms_.empty()) return sums;
    constexpr double kLeast = 1e-9;
    const Eigen::Vector2d size = box_.sizes().cwiseMax(kLeast);
    const Eigen::Vector2d per_unit(kColumns / size.x(), kRows / size.y());
    for (const Term& term : terms_) {
      sums[cell_of((term.x - box_.min()).cwiseProduct(per_unit))] += term.gradient;
    }
    return sums;
  }

  /// @param at  [cells] from the corner
  static std::size_t cell_of(const Eigen::Vector2d& at) {
    const int column = std::clamp(static_cast<int>(at.x()), 0, kColumns - 1);
    const int row = std::clamp(static_cast<int>(at.y()), 0, kRows - 1);
    return static_cast<std::size_t>(row) * kColumns + static_cast<std::size_t>(column);
  }

  std::vector<Term> terms_;
  Eigen::AlignedBox2d box_;
};

}  // namespace oneac
