#include "patch_transfer.h"
#include "window_problem.h"

#include "oneac/geometry/robust_loss.h"

#include <cmath>
#include <vector>

namespace oneac {

Eigen::Matrix<double, 6, 6> view_information(const SlidingWindow& window, std::size_t view,
                                             const WindowRefineOptions& options) {
  using Matrix26 = Eigen::Matrix<double, 2, 6>;
  const double c2 = options.loss_sigmas * options.loss_sigmas;
  const std::size_t count = window.landmarks.size();
  std::vector<double> rho_information(count, 0.0);
  struct Seen {
    Matrix26 J;
    Eigen::Vector2d j_rho;
    double weight;
    std::size_t landmark;
  };
  std::vector<Seen> here;
  for (const WindowObservation& seen : window.observations) {
    const WindowLandmark& patch = window.landmarks[seen.landmark];
    if (seen.view == patch.anchor) continue;
    const PatchTransfer transfer(window.views[patch.anchor].T_view_map,
                                 window.views[seen.view].T_view_map, patch);
    if (!transfer.in_front()) continue;
    const double sigma = point_sigma(seen, window, options);
    const double r2 = ((transfer.point() - seen.x) / sigma).squaredNorm();
    const double weight = cauchy_weight(r2, c2);
    const auto d = transfer.point_derivative();
    const Eigen::Vector2d j_rho = d.patch.col(2) / sigma;
    if (seen.view == view) {
      here.push_back({d.view / sigma, j_rho, weight, seen.landmark});
    } else {
      rho_information[seen.landmark] += weight * j_rho.squaredNorm();
    }
  }
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  for (const Seen& s : here) {
    const double known = rho_information[s.landmark];
    // Depth marginalised: W = I − j jᵀ / (I_ρ + jᵀ j), weights of the loss included.
    const Eigen::Vector2d j = std::sqrt(s.weight) * s.j_rho;
    const double total = known + j.squaredNorm();
    Eigen::Matrix2d W = s.weight * Eigen::Matrix2d::Identity();
    if (total > 0.0) W -= s.weight * j * j.transpose() / total;
    information += s.J.transpose() * W * s.J;
  }
  return information;
}

}  // namespace oneac
