#include "oneac/refine/epipolar_terms.h"

#include <Eigen/Geometry>

#include <cmath>

namespace oneac {

EpipolarTerm<1> point_term(const Eigen::Matrix3d& E, const AffineCorrespondence& ac,
                           const CorrespondenceNoise& noise) {
  EpipolarTerm<1> term;
  term.dE[0].setZero();
  const Eigen::Vector3d p = ac.x1.homogeneous();
  const Eigen::Vector3d q = ac.x2.homogeneous();
  const Eigen::Vector2d a = E.topRows<2>() * p;
  const Eigen::Vector2d b = E.leftCols<2>().transpose() * q;
  const double s2 = noise.point * noise.point * (a.squaredNorm() + b.squaredNorm());
  if (!(s2 > 0.0)) return term;
  const double s = std::sqrt(s2);
  const double e = q.dot(E * p);
  // ∂(e / s) = ∂e / s − e / s³ · ∂(s²) / 2
  Eigen::Matrix3d half_ds2 = Eigen::Matrix3d::Zero();
  half_ds2.topRows<2>() += a * p.transpose();
  half_ds2.leftCols<2>() += q * b.transpose();
  half_ds2 *= noise.point * noise.point;
  term.r(0) = e / s;
  term.dE[0] = (q * p.transpose() - (e / s2) * half_ds2) / s;
  return term;
}

EpipolarTerm<2> affine_term(const Eigen::Matrix3d& E, const AffineCorrespondence& ac,
                            const CorrespondenceNoise& noise) {
  EpipolarTerm<2> term;
  for (Eigen::Matrix3d& derivative : term.dE) derivative.setZero();
  const Eigen::Vector3d p = ac.x1.homogeneous();
  const Eigen::Vector3d q = ac.x2.homogeneous();
  const Eigen::Vector2d a = E.topRows<2>() * p;
  const Eigen::Vector2d e = ac.A.transpose() * a + E.leftCols<2>().transpose() * q;
  const Eigen::Matrix2d E22 = E.topLeftCorner<2, 2>();
  const double affine2 = noise.affine * noise.affine;
  const double half_point2 = 0.5 * noise.point * noise.point;
  const double s2 = affine2 * a.squaredNorm() +
                    half_point2 * ((ac.A.transpose() * E22).squaredNorm() + E22.squaredNorm());
  if (!(s2 > 0.0)) return term;
  const double s = std::sqrt(s2);
  Eigen::Matrix3d half_ds2 = Eigen::Matrix3d::Zero();
  half_ds2.topRows<2>() += affine2 * a * p.transpose();
  half_ds2.topLeftCorner<2, 2>() += half_point2 * (ac.A * (ac.A.transpose() * E22) + E22);
  term.r = e / s;
  for (int k = 0; k < 2; ++k) {
    Eigen::Matrix3d de = Eigen::Matrix3d::Zero();
    de.topRows<2>() = ac.A.col(k) * p.transpose();
    de.col(k) += q;
    term.dE[k] = (de - (e(k) / s2) * half_ds2) / s;
  }
  return term;
}

Eigen::Matrix<double, 1, 6> pose_derivative(const Eigen::Matrix3d& dE, const RelativePose& pose) {
  // With ⟨·,·⟩ over columns: ⟨dE, [v]× R⟩ = v · Σ R_j × dE_j, and likewise for [t]× [w]× R.
  const Eigen::Matrix3d dR = cross_matrix(pose.t).transpose() * dE;
  Eigen::Vector3d dw = Eigen::Vector3d::Zero();
  Eigen::Vector3d dv = Eigen::Vector3d::Zero();
  for (int j = 0; j < 3; ++j) {
    dw += pose.R.col(j).cross(dR.col(j));
    dv += pose.R.col(j).cross(dE.col(j));
  }
  Eigen::Matrix<double, 1, 6> derivative;
  derivative << dw.transpose(), dv.transpose();
  return derivative;
}

}  // namespace oneac
