#include "window_equations.h"

#include "window_problem.h"

#include "oneac/geometry/robust_loss.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

using internal::block_at;
using internal::PointRow;
using internal::PoseBlockSum;
using internal::PoseDerivative;
using internal::PoseSum;
using internal::simd_kernels;
using internal::WindowKernels;
using internal::WindowLink;

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

WindowEquations::WindowEquations(const SlidingWindow& window, const WindowRefineOptions& options)
    : views_(window.views.size()), c2_(options.loss_sigmas * options.loss_sigmas) {
  add_columns(window);
  add_rows(window, options);
  add_priors(window, options);
  H_.resize(free_views_ * (free_views_ + 1) / 2);
  g_.resize(free_views_);
}

void WindowEquations::add_columns(const SlidingWindow& window) {
  for (const WindowView& view : window.views) {
    free_.push_back(view.fixed ? kNone : free_views_++);
  }
}

void WindowEquations::add_rows(const SlidingWindow& window, const WindowRefineOptions& options) {
  // By landmark, in the order given.
  std::vector<std::vector<std::size_t>> seen_by(window.landmarks.size());
  for (std::size_t i = 0; i < window.observations.size(); ++i) {
    seen_by[window.observations[i].landmark].push_back(i);
  }
  landmarks_.resize(window.landmarks.size());
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    Landmark& landmark = landmarks_[i];
    landmark.anchor = window.landmarks[i].anchor;
    landmark.first_row = rows_.size();
    landmark.first_link = landmark.last_link = links_.size();
    bool second_view = false;
    for (const std::size_t k : seen_by[i]) {
      const WindowObservation& seen = window.observations[k];
      if (!is_in_front(window, seen)) continue;
      second_view = second_view || seen.view != landmark.anchor;
      rows_.push_back({seen.x, 1.0 / point_sigma(seen, window, options), seen.view, kNone});
    }
    if (!second_view) rows_.resize(landmark.first_row);  // a ray without depth says nothing
    landmark.last_row = rows_.size();
    if (!second_view) continue;
    landmark.anchor_link = link_of(landmark, landmark.anchor);
    for (std::size_t k = landmark.first_row; k < landmark.last_row; ++k) {
      rows_[k].link = link_of(landmark, rows_[k].view);
    }
  }
}

std::size_t WindowEquations::link_of(Landmark& landmark, std::size_t view) {
  const std::size_t free = free_[view];
  if (free == kNone) return kNone;
  for (std::size_t k = landmark.first_link; k < landmark.last_link; ++k) {
    if (links_[k].view == free) return k;
  }
  links_.push_back({{}, {}, free});
  landmark.last_link = links_.size();
  return landmark.last_link - 1;
}

void WindowEquations::add_priors(const SlidingWindow& window, const WindowRefineOptions& options) {
  for (std::size_t i = 0; i + 1 < window.views.size(); ++i) {
    if (window.views[i].fixed && window.views[i + 1].fixed) continue;
    priors_.push_back({i, planar_prior(window, i, options)});
  }
}

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

std::optional<double> WindowEquations::cost(const WindowState& state) const {
  const std::vector<Transfer> all = transfers(state);
  double sum = 0.0;
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    const Landmark& landmark = landmarks_[i];
    const Eigen::Vector3d& point = state.points[i];
    const Eigen::Vector3d ray(point.x(), point.y(), 1.0);
    for (std::size_t k = landmark.first_row; k < landmark.last_row; ++k) {
      const Row& row = rows_[k];
      const Transfer& transfer = all[landmark.anchor * views_ + row.view];
      const bool own = row.view == landmark.anchor;
      const Eigen::Vector3d y = own ? ray : transfer.R * ray + point.z() * transfer.t;
      if (!(y.z() > kClosest)) return std::nullopt;
      const double r2 = ((y.head<2>() / y.z() - row.x) * row.inverse_sigma).squaredNorm();
      sum += c2_ * std::log1p(r2 / c2_);
    }
  }
  for (const Prior& prior : priors_) {
    sum += planar_residuals(prior.prior, state.poses[prior.view], state.poses[prior.view + 1])
               .squaredNorm();
  }
  if (!std::isfinite(sum)) return std::nullopt;
  return 0.5 * sum;
}

void WindowEquations::linearise(const WindowState& state) {
  std::fill(H_.begin(), H_.end(), PoseBlockSum{});
  std::fill(g_.begin(), g_.end(), PoseSum{});
  for (WindowLink& link : links_) link.W = {};
  const std::vector<Transfer> all = transfers(state);
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    Landmark& landmark = landmarks_[i];
    landmark.H.setZero();
    landmark.g.setZero();
    for (std::size_t k = landmark.first_row; k < landmark.last_row; ++k) {
      const Row& row = rows_[k];
      if (row.view == landmark.anchor) {
        linearise_anchor(row, state.points[i], landmark);
      } else {
        linearise_row(row, all[landmark.anchor * views_ + row.view], state, state.points[i],
                      landmark);
      }
    }
  }
  linearise_priors(state);
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
                                    Landmark& landmark) {
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
  const PointRow here{{r.x(), r.y()}, {{J(0, 0), J(0, 1), J(0, 2)}, {J(1, 0), J(1, 1), J(1, 2)}}};
  PoseDerivative by_view, by_anchor;
  if (row.link != kNone) {
    const Eigen::Vector3d q = y - rho * state.poses[row.view].t;
    for (int i = 0; i < 2; ++i) store(q.cross(D.col(i)), rho * D.col(i), by_view.row[i]);
    add_view(here, by_view, links_[row.link]);
  }
  if (landmark.anchor_link == kNone) return;
  const Eigen::Vector3d m = ray - rho * state.poses[landmark.anchor].t;
  for (int i = 0; i < 2; ++i) store(G.col(i).cross(m), -rho * G.col(i), by_anchor.row[i]);
  add_view(here, by_anchor, links_[landmark.anchor_link]);
  if (row.link == kNone) return;
  const std::size_t view = links_[row.link].view, anchor = links_[landmark.anchor_link].view;
  if (view > anchor) {
    simd_kernels<WindowKernels>().add_pair(by_view, by_anchor, H_[block_at(view, anchor)]);
  } else {
    simd_kernels<WindowKernels>().add_pair(by_anchor, by_view, H_[block_at(anchor, view)]);
  }
}

void WindowEquations::add_view(const PointRow& here, const PoseDerivative& J, WindowLink& link) {
  simd_kernels<WindowKernels>().add_view(here, J, H_[block_at(link.view, link.view)], g_[link.view],
                                         link.W);
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
