#include "window_equations.h"

#include "oneac/geometry/robust_loss.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace oneac {
namespace {

using internal::block_at;
using internal::PoseBlockSum;
using internal::PoseSum;
using internal::simd_kernels;
using internal::WindowKernels;

constexpr double kClosest = 1e-9;  // y_z of a point in front, as in PatchTransfer

/// A row of a derivative by (w, v).
void store(const Eigen::Vector3d& by_w, const Eigen::Vector3d& by_v, double* row) {
  for (int k = 0; k < 3; ++k) row[k] = by_w(k);
  for (int k = 0; k < 3; ++k) row[3 + k] = by_v(k);
  row[6] = row[7] = 0.0;
}

void add(const Eigen::Matrix<double, 6, 6>& block, PoseBlockSum& sum) {
  for (int c = 0; c < 6; ++c) {
    for (int i = 0; i < 6; ++i) sum.column[c][i] += block(i, c);
  }
}

void add(const Eigen::Matrix<double, 6, 1>& vector, PoseSum& sum) {
  for (int i = 0; i < 6; ++i) sum.entry[i] += vector(i);
}

}  // namespace

std::vector<WindowEquations::Transfer> WindowEquations::transfers(const WindowState& state) const {
  std::vector<Transfer> all(views_ * views_);
  for (std::size_t a = 0; a < views_; ++a) {
    for (std::size_t k = 0; k < views_; ++k) {
      Transfer& transfer = all[a * views_ + k];
      transfer.R = state.poses[k].R * state.poses[a].R.transpose();
      transfer.t = state.poses[k].t - transfer.R * state.poses[a].t;
    }
  }
  return all;
}

bool WindowEquations::row_costs(std::size_t i, const std::vector<Transfer>& all,
                                const WindowState& state, std::vector<double>& costs) const {
  const Landmark& landmark = landmarks_[i];
  const Eigen::Vector3d& point = state.points[i];
  const Eigen::Vector3d ray(point.x(), point.y(), 1.0);
  for (std::size_t k = landmark.first_row; k < landmark.last_row; ++k) {
    const Row& row = rows_[k];
    const Transfer& transfer = all[landmark.anchor * views_ + row.view];
    const bool own = row.view == landmark.anchor;
    const Eigen::Vector3d y = own ? ray : transfer.R * ray + point.z() * transfer.t;
    if (!(y.z() > kClosest)) return false;
    const double r2 = ((y.head<2>() / y.z() - row.x) * row.inverse_sigma).squaredNorm();
    costs[k] = c2_ * std::log1p(r2 / c2_);
  }
  return true;
}

std::optional<double> WindowEquations::cost(const WindowState& state) const {
  const std::vector<Transfer> all = transfers(state);
  std::vector<double> costs(rows_.size());
  std::atomic<bool> is_behind{false};
  workers_.share(landmarks_.size(), [&](std::size_t i, std::size_t) {
    if (!row_costs(i, all, state, costs)) is_behind = true;
  });
  if (is_behind) return std::nullopt;
  double sum = 0.0;
  for (const double row : costs) sum += row;
  for (const Prior& prior : priors_) {
    sum += planar_residuals(prior.prior, state.poses[prior.view], state.poses[prior.view + 1])
               .squaredNorm();
  }
  if (!std::isfinite(sum)) return std::nullopt;
  return 0.5 * sum;
}

void WindowEquations::linearise(const WindowState& state) {
  const std::vector<Transfer> all = transfers(state);
  workers_.share(landmarks_.size(),
                 [&](std::size_t i, std::size_t) { linearise_landmark(i, all, state); });
  workers_.share(blocks_.size(), [&](std::size_t i, std::size_t) {
    PoseSum* const g = blocks_[i].is_diagonal() ? &g_[blocks_[i].row] : nullptr;
    if (g != nullptr) *g = {};
    H_[i] = {};
    simd_kernels<WindowKernels>().add_pairs(derivatives_.begin(i), derivatives_.end(i), H_[i], g);
  });
  linearise_priors(state);
}

void WindowEquations::linearise_landmark(std::size_t i, const std::vector<Transfer>& all,
                                         const WindowState& state) {
  Landmark& landmark = landmarks_[i];
  landmark.H.setZero();
  landmark.g.setZero();
  for (std::size_t k = landmark.first_link; k < landmark.last_link; ++k) links_[k].W = {};
  for (std::size_t k = landmark.first_row; k < landmark.last_row; ++k) {
    const Row& row = rows_[k];
    if (row.view == landmark.anchor) {
      linearise_anchor(row, state.points[i], landmark);
    } else {
      linearise_row(row, all[landmark.anchor * views_ + row.view], state, state.points[i], landmark,
                    terms_[k]);
    }
  }
}

void WindowEquations::linearise_anchor(const Row& row, const Eigen::Vector3d& point,
                                       Landmark& landmark) const {
  const Eigen::Vector2d r = (point.head<2>() - row.x) * row.inverse_sigma;
  const double slope = row.inverse_sigma / (1.0 + r.squaredNorm() / c2_);
  landmark.H(0, 0) += slope * row.inverse_sigma;
  landmark.H(1, 1) += slope * row.inverse_sigma;
  landmark.g.head<2>() += slope * r;
}

// The derivatives are those of PatchTransfer, written row by row: d·[q]× = d × q.
void WindowEquations::linearise_row(const Row& row, const Transfer& transfer,
                                    const WindowState& state, const Eigen::Vector3d& point,
                                    Landmark& landmark, RowTerms& terms) {
  const Eigen::Vector3d ray(point.x(), point.y(), 1.0);
  const double rho = point.z();
  const Eigen::Vector3d y = transfer.R * ray + rho * transfer.t;
  const Eigen::Vector2d u = y.head<2>() / y.z();
  Eigen::Vector2d r = (u - row.x) * row.inverse_sigma;
  const double root = std::sqrt(cauchy_weight(r.squaredNorm(), c2_));
  r *= root;
  const double scale = root * row.inverse_sigma / y.z();
  Eigen::Matrix<double, 3, 2> D;  // both rows of Dπ, as columns
  D << scale, 0.0, 0.0, scale, -scale * u.x(), -scale * u.y();
  const Eigen::Matrix<double, 3, 2> G = transfer.R.transpose() * D;
  Eigen::Matrix<double, 2, 3> J;
  J.leftCols<2>() = G.topRows<2>().transpose();
  J.col(2) = D.transpose() * transfer.t;
  landmark.H += J.transpose() * J;
  landmark.g += J.transpose() * r;
  terms.here = {{r.x(), r.y()}, {{J(0, 0), J(0, 1), J(0, 2)}, {J(1, 0), J(1, 1), J(1, 2)}}};
  const WindowKernels& kernels = simd_kernels<WindowKernels>();
  if (row.link != kNone) {
    const Eigen::Vector3d q = y - rho * state.poses[row.view].t;
    for (int i = 0; i < 2; ++i) store(q.cross(D.col(i)), rho * D.col(i), terms.by_view.row[i]);
    kernels.add_coupling(terms.here, terms.by_view, links_[row.link].W);
  }
  if (landmark.anchor_link == kNone) return;
  const Eigen::Vector3d m = ray - rho * state.poses[landmark.anchor].t;
  for (int i = 0; i < 2; ++i) store(G.col(i).cross(m), -rho * G.col(i), terms.by_anchor.row[i]);
  kernels.add_coupling(terms.here, terms.by_anchor, links_[landmark.anchor_link].W);
}

void WindowEquations::linearise_priors(const WindowState& state) {
  for (const Prior& prior : priors_) {
    const RelativePose& first = state.poses[prior.view];
    const RelativePose& second = state.poses[prior.view + 1];
    const Eigen::Vector3d r = planar_residuals(prior.prior, first, second);
    const PlanarDerivative d = planar_derivative(prior.prior, first, second);
    const std::size_t a = free_[prior.view], b = free_[prior.view + 1];
    if (a != kNone) add(d.first.transpose() * d.first, H_[block_at(a, a)]);
    if (a != kNone) add(d.first.transpose() * r, g_[a]);
    if (b != kNone) add(d.second.transpose() * d.second, H_[block_at(b, b)]);
    if (b != kNone) add(d.second.transpose() * r, g_[b]);
    if (a != kNone && b != kNone) add(d.second.transpose() * d.first, H_[block_at(b, a)]);
  }
}

}  // namespace oneac
