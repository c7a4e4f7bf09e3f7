#include "oneac/geometry/tangent_basis.h"

#include <Eigen/Geometry>

namespace oneac {

Eigen::Matrix<double, 3, 2> tangent_basis(const Eigen::Vector3d& t) {
  Eigen::Index smallest = 0;
  t.cwiseAbs().minCoeff(&smallest);
  Eigen::Matrix<double, 3, 2> T;
  T.col(0) = t.cross(Eigen::Vector3d::Unit(smallest)).normalized();
  T.col(1) = t.cross(T.col(0));
  return T;
}

}  // namespace oneac
