#include "window_equations.h"

#include "window_problem.h"

#include "oneac/geometry/robust_loss.h"

#include <Eigen/Geometry>

#include <cmath>

namespace oneac {
namespace {

constexpr double kClosest = 1e-9;  // y_z of a point in front, as in PatchTransfer

}  // namespace

WindowEquations::WindowEquations(const SlidingWindow& window, const WindowRefineOptions& options)
    : views_(window.views.size()), c2_(options.loss_sigmas * options.loss_sigmas) {
  add_columns(window);
  add_rows(window, options);
  add_priors(window, options);
  H_.resize(size_, size_);
  g_.resize(size_);
}

void WindowEquations::add_columns(const SlidingWindow& window) {
  for (const WindowView& view : window.views) {
    columns_.push_back(view.fixed ? -1 : size_);
    if (!view.fixed) size_ += 6;
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
  const std::ptrdiff_t column = columns_[view];
  if (column < 0) return kNone;
  for (std::size_t k = landmark.first_link; k < landmark.last_link; ++k) {
    if (links_[k].column == column) return k;
  }
  links_.push_back({column, Matrix36::Zero(), Matrix36::Zero()});
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
  H_.setZero();
  g_.setZero();
  for (Link& link : links_) link.W.setZero();
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
  const auto block = [&](std::size_t link, const Matrix26& J_pose) {
    const std::ptrdiff_t column = links_[link].column;
    H_.block<6, 6>(column, column) += J_pose.transpose() * J_pose;
    g_.segment<6>(column) += J_pose.transpose() * r;
    links_[link].W += J.transpose() * J_pose;
  };
  Matrix26 J_view, J_anchor;
  if (row.link != kNone) {
    const Eigen::Vector3d q = y - rho * state.poses[row.view].t;
    J_view << q.cross(D.col(0)).transpose(), rho * D.col(0).transpose(),
        q.cross(D.col(1)).transpose(), rho * D.col(1).transpose();
    block(row.link, J_view);
  }
  if (landmark.anchor_link == kNone) return;
  const Eigen::Vector3d m = ray - rho * state.poses[landmark.anchor].t;
  J_anchor << G.col(0).cross(m).transpose(), -rho * G.col(0).transpose(),
      G.col(1).cross(m).transpose(), -rho * G.col(1).transpose();
  block(landmark.anchor_link, J_anchor);
  if (row.link == kNone) return;
  const std::ptrdiff_t view = links_[row.link].column;
  const std::ptrdiff_t anchor = links_[landmark.anchor_link].column;
  if (view > anchor) {
    H_.block<6, 6>(view, anchor) += J_view.transpose() * J_anchor;
  } else {
    H_.block<6, 6>(anchor, view) += J_anchor.transpose() * J_view;
  }
}

void WindowEquations::linearise_priors(const WindowState& state) {
  for (const Prior& prior : priors_) {
    const RelativePose& first = state.poses[prior.view];
    const RelativePose& second = state.poses[prior.view + 1];
    const Eigen::Vector3d r = planar_residuals(prior.prior, first, second);
    const PlanarDerivative d = planar_derivative(prior.prior, first, second);
    const std::ptrdiff_t a = columns_[prior.view];
    const std::ptrdiff_t b = columns_[prior.view + 1];
    if (a >= 0) H_.block<6, 6>(a, a) += d.first.transpose() * d.first;
    if (a >= 0) g_.segment<6>(a) += d.first.transpose() * r;
    if (b >= 0) H_.block<6, 6>(b, b) += d.second.transpose() * d.second;
    if (b >= 0) g_.segment<6>(b) += d.second.transpose() * r;
    if (a >= 0 && b >= 0) H_.block<6, 6>(b, a) += d.second.transpose() * d.first;
  }
}

}  // namespace oneac
