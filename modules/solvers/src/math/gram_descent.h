#pragma once

#include "math/epipolar_rows.h"

#include <Eigen/Dense>

#include <algorithm>

namespace oneac::internal {

/// Levenberg-Marquardt on eᵀ G e over the degrees of freedom of a motion.
/// @tparam Model  has e (its E, row by row), J (9×D, the derivatives of e) and moved(Δ), the model
///                Δ away
/// @return the least cost; `model` is where it was found
template <class Model>
double descend(const Gram9& gram, Model& model) {
  constexpr int kDescentSteps = 30;
  constexpr double kDescentStep = 1e-12;  // [rad]
  constexpr int kFreedoms = decltype(Model::J)::ColsAtCompileTime;
  using Step = Eigen::Matrix<double, kFreedoms, 1>;
  double cost = model.e.dot(gram * model.e);
  const double rounding = 1e-16 * gram.trace();  // costs that differ by less are equal
  double damping = 1e-6;
  for (int step = 0; step < kDescentSteps; ++step) {
    const auto& J = model.J;
    Eigen::Matrix<double, kFreedoms, kFreedoms> N = J.transpose() * gram * J;
    const Step gradient = J.transpose() * (gram * model.e);
    N.diagonal() *= 1.0 + damping;
    const Step delta = N.ldlt().solve(gradient);
    if (!delta.allFinite()) break;
    const Model next = model.moved(-delta);
    const double next_cost = next.e.dot(gram * next.e);
    if (next_cost <= cost + rounding) {
      model = next;
      cost = std::min(cost, next_cost);
      damping *= 0.1;
      if (delta.norm() < kDescentStep) break;
    } else {
      damping = std::max(damping * 10.0, 1e-9);
      if (damping > 1e6) break;
    }
  }
  return cost;
}

}  // namespace oneac::internal
