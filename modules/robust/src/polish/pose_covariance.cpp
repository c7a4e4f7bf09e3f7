#include "polish/pose_covariance.h"

#include <Eigen/Dense>

namespace oneac::internal {

Eigen::Matrix<double, 6, 6> pose_covariance(const PolishResult& polished,
                                            const RobustResult& result, double squares) {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  constexpr std::size_t kUnknowns = 5;
  if (result.inlier_count <= kUnknowns) return Matrix6::Zero();
  const double variance = squares / static_cast<double>(result.inlier_count - kUnknowns);
  // b is given by its coordinates along the tangent basis; ±t have the same basis up to the sign.
  Eigen::Matrix<double, 6, 5> basis = Eigen::Matrix<double, 6, 5>::Zero();
  basis.topLeftCorner<3, 3>().setIdentity();
  const double sign = polished.pose.t.dot(result.pose.t) < 0.0 ? -1.0 : 1.0;
  basis.bottomRightCorner<3, 2>() = sign * tangent_basis(polished.pose.t);
  const Eigen::LDLT<Eigen::Matrix<double, 5, 5>> factor(polished.information);
  if (!factor.isPositive()) return Matrix6::Zero();
  const Matrix6 covariance =
      variance * basis * factor.solve(Eigen::Matrix<double, 5, 5>::Identity()) * basis.transpose();
  return covariance.allFinite() ? covariance : Matrix6::Zero();
}

}  // namespace oneac::internal
