#include "patch_transfer.h"
#include "window_problem.h"

#include <Eigen/Cholesky>

#include <vector>

namespace oneac {
namespace {

/// Normal equations of one patch's gradient.
struct GradientSystem {
  Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
  Eigen::Vector2d h = Eigen::Vector2d::Zero();
};

/// 1σ of a gradient before any affinity speaks: inverse depth may change by its own size over a
/// tenth of the focal length, a surface seen at 5°.
double prior_information(double inverse_depth) {
  constexpr double kSteepest = 10.0;
  const double sigma = kSteepest * inverse_depth;
  return sigma > 0.0 ? 1.0 / (sigma * sigma) : 1.0;
}

/// A = Dπ R₂ + (Dπ t) gᵀ: linear in g.
void add(const PatchTransfer& transfer, const WindowObservation& seen, double sigma,
         GradientSystem& system) {
  const Eigen::Vector2d u = transfer.point();
  Eigen::Matrix<double, 2, 3> D;
  D << 1.0, 0.0, -u.x(), 0.0, 1.0, -u.y();
  D /= transfer.y.z();
  const Eigen::Matrix2d rest = seen.A - D * transfer.R_view_anchor.leftCols<2>();
  const Eigen::Vector2d a = D * transfer.t_view_anchor;
  const double weight = 1.0 / (sigma * sigma);
  system.H += weight * a.squaredNorm() * Eigen::Matrix2d::Identity();
  system.h += weight * rest.transpose() * a;
}

}  // namespace

std::size_t fit_patches(SlidingWindow& window, const WindowRefineOptions& options) {
  const auto transfer_of = [&](const WindowObservation& seen) {
    const WindowLandmark& patch = window.landmarks[seen.landmark];
    return PatchTransfer(window.views[patch.anchor].T_view_map, window.views[seen.view].T_view_map,
                         patch);
  };
  const auto has_affinity = [&](const WindowObservation& seen) {
    return seen.view != window.landmarks[seen.landmark].anchor && seen.affine_sigma >= 0.0;
  };
  std::vector<GradientSystem> systems(window.landmarks.size());
  for (const WindowObservation& seen : window.observations) {
    if (!has_affinity(seen)) continue;
    const PatchTransfer transfer = transfer_of(seen);
    if (transfer.in_front())
      add(transfer, seen, affine_sigma(seen, options), systems[seen.landmark]);
  }
  for (std::size_t i = 0; i < systems.size(); ++i) {
    WindowLandmark& patch = window.landmarks[i];
    const double prior = prior_information(patch.inverse_depth);
    const Eigen::Matrix2d H = systems[i].H + prior * Eigen::Matrix2d::Identity();
    patch.gradient = H.ldlt().solve(systems[i].h);
    // The affinities know more than the prior did: the normal is measured.
    patch.has_gradient = systems[i].H(0, 0) > prior && patch.gradient.allFinite();
    if (!patch.gradient.allFinite()) patch.gradient.setZero();
  }
  std::size_t count = 0;
  for (WindowObservation& seen : window.observations) {
    seen.affine_consistent = false;
    if (!has_affinity(seen)) continue;
    const PatchTransfer transfer = transfer_of(seen);
    if (!transfer.in_front()) continue;
    const double sigma = affine_sigma(seen, options);
    const double chi2 = (transfer.affinity() - seen.A).squaredNorm() / (sigma * sigma);
    seen.affine_consistent = chi2 <= options.affine_gate_chi2;
    if (seen.affine_consistent) ++count;
  }
  return count;
}

}  // namespace oneac
