#pragma once

#include "oneac/geometry/relative_pose.h"
#include "oneac/refine/sliding_window.h"

#include <Eigen/Core>

namespace oneac {

using Matrix36 = Eigen::Matrix<double, 3, 6>;
using Matrix35 = Eigen::Matrix<double, 3, 5>;

/// How a patch of an anchor view appears in another view.
///
/// Every column c with weight s of (c, s) = ((x, 1), ρ), (e1, g1), (e2, g2) is carried by
///   F(c, s) = R_k R_aᵀ (c − s t_a) + s t_k,
/// the first gives the ray y, the other two its derivative along the anchor's image, B = ∂y/∂x.
/// Then x_k = π(y) and A = Dπ(y) B. The columns of derivatives are those of the views' (w, v),
/// R ← exp([w]×) R, t ← t + v, and of (x, ρ, g).
struct PatchTransfer {
  PatchTransfer(const RelativePose& anchor, const RelativePose& view, const WindowLandmark& patch);

  [[nodiscard]] bool in_front() const { return y.z() > 1e-9; }
  [[nodiscard]] Eigen::Vector2d point() const { return y.head<2>() / y.z(); }
  [[nodiscard]] Eigen::Matrix2d affinity() const;

  /// ∂(point)/∂(w, v) of the anchor, of the view, ∂(point)/∂(x, ρ).
  struct PointDerivative {
    Eigen::Matrix<double, 2, 6> anchor, view;
    Eigen::Matrix<double, 2, 3> patch;
  };
  [[nodiscard]] PointDerivative point_derivative() const;

  /// The same of the four entries of A, column by column, and of (x, ρ, g).
  struct AffineDerivative {
    Eigen::Matrix<double, 4, 6> anchor, view;
    Eigen::Matrix<double, 4, 5> patch;
  };
  [[nodiscard]] AffineDerivative affine_derivative() const;

  Eigen::Vector3d y;              ///< ray in the view, times the anchor's depth
  Eigen::Matrix<double, 3, 2> B;  ///< ∂y/∂x
  Eigen::Matrix3d R_view_anchor;
  Eigen::Vector3d t_view_anchor;

 private:
  [[nodiscard]] Eigen::Matrix<double, 2, 3> projection() const;
  /// ∂F/∂(w, v) of the anchor and of the view for one column.
  [[nodiscard]] Matrix36 anchor_column(const Eigen::Vector3d& c, double s) const;
  [[nodiscard]] Matrix36 view_column(const Eigen::Vector3d& F, double s) const;

  Eigen::Vector3d t_anchor_, t_view_;
  Eigen::Vector3d ray_;
  double rho_;
  Eigen::Vector2d gradient_;
};

}  // namespace oneac
