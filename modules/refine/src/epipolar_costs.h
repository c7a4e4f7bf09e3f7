#pragma once

#include "oneac/refine/epipolar_terms.h"

#include <ceres/sized_cost_function.h>

namespace oneac {

/// A term of N residuals as a Ceres cost. Parameter blocks: the rotation as a quaternion (x, y, z,
/// w; Eigen's order) and t, each on its manifold. The derivatives are those of the polynomial R(q)
/// of Quaterniond::toRotationMatrix and of a free t; the manifolds project them.
template <int N, EpipolarTerm<N> (*Term)(const Eigen::Matrix3d&, const AffineCorrespondence&,
                                         const CorrespondenceNoise&)>
class EpipolarCost final : public ceres::SizedCostFunction<N, 4, 3> {
 public:
  EpipolarCost(const AffineCorrespondence& ac, const CorrespondenceNoise& noise)
      : ac_(ac), noise_(noise) {}

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  AffineCorrespondence ac_;
  CorrespondenceNoise noise_;
};

using PointCost = EpipolarCost<1, point_term>;
using AffineCost = EpipolarCost<2, affine_term>;

extern template class EpipolarCost<1, point_term>;
extern template class EpipolarCost<2, affine_term>;

}  // namespace oneac
