#include "pose_covariance.h"

#include "oneac/geometry/essential.h"

#include <Eigen/Dense>

namespace oneac::internal {

Eigen::Matrix<double, 6, 6> pose_covariance(const PolishResult& polished,
                                            const RobustResult& result, AcSpan acs) {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  constexpr std::size_t kUnknowns = 5;
  if (result.inlier_count <= kUnknowns) return Matrix6::Zero();
  const Eigen::Matrix3d E = essential_matrix(polished.pose);
  double squares = 0.0;
  for (std::size_t i = 0; i < acs.size(); ++i) {
    if (!result.inliers[i]) continue;
    const double r = sampson_distance(E, acs[i].x1, acs[i].x2);
    squares += r * r;
  }
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
