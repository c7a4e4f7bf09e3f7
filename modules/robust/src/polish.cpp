#include "oneac/robust/polish.h"

#include "oneac/geometry/essential.h"

#include <Eigen/Dense>

#include <cmath>

namespace oneac {
namespace {

using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;
using Matrix95 = Eigen::Matrix<double, 9, 5>;

constexpr double kConverged = 1e-9;  // [rad] steps below it change nothing that images could show
constexpr double kFirstDamping = 1e-4;  // of the diagonal; ordinary LM start

/// An orthonormal basis of the plane perpendicular to the unit vector t, continuous in t but for a
/// switch of axis.
Eigen::Matrix<double, 3, 2> tangent_basis(const Eigen::Vector3d& t) {
  Eigen::Index smallest = 0;
  t.cwiseAbs().minCoeff(&smallest);
  Eigen::Matrix<double, 3, 2> T;
  T.col(0) = t.cross(Eigen::Vector3d::Unit(smallest)).normalized();
  T.col(1) = t.cross(T.col(0));
  return T;
}

/// E (row-major in nine numbers) and its derivative with respect to the five parameters.
struct Linearisation {
  Eigen::Matrix3d E;
  Matrix95 dE;  // row 3 i + j: derivative of E(i, j)

  explicit Linearisation(const RelativePose& pose) : E(essential_matrix(pose)) {
    const Eigen::Matrix<double, 3, 2> T = tangent_basis(pose.t);
    const Eigen::Matrix3d tx = cross_matrix(pose.t);
    for (int k = 0; k < 3; ++k) {
      set_column(k, tx * cross_matrix(Eigen::Vector3d::Unit(k)) * pose.R);
    }
    for (int k = 0; k < 2; ++k) set_column(3 + k, cross_matrix(T.col(k)) * pose.R);
  }

 private:
  void set_column(int column, const Eigen::Matrix3d& derivative) {
    for (int i = 0; i < 9; ++i) dE(i, column) = derivative(i / 3, i % 3);
  }
};

SampsonJacobian evaluate(const Linearisation& l, const Eigen::Vector2d& x1,
                         const Eigen::Vector2d& x2) {
  const Eigen::Vector3d p(x1.x(), x1.y(), 1.0);
  const Eigen::Vector3d q(x2.x(), x2.y(), 1.0);
  const Eigen::Vector3d Ep = l.E * p;
  const Eigen::Vector3d Etq = l.E.transpose() * q;
  const double gradient = Ep.head<2>().squaredNorm() + Etq.head<2>().squaredNorm();
  if (!(gradient > 0.0)) return {};
  const double inverse_root = 1.0 / std::sqrt(gradient);
  const double r = q.dot(Ep) * inverse_root;
  // dr/dE = (q pᵀ − r/√g · ([Ep]₁₂ pᵀ + q [Eᵀq]₁₂ᵀ)) / √g
  const double k = r * inverse_root;
  const Eigen::Vector3d left = q - k * Eigen::Vector3d(Ep.x(), Ep.y(), 0.0);
  Eigen::Matrix<double, 1, 9> drdE;
  for (int i = 0; i < 3; ++i) {
    drdE(3 * i) = (left(i) * p.x() - k * q(i) * Etq.x()) * inverse_root;
    drdE(3 * i + 1) = (left(i) * p.y() - k * q(i) * Etq.y()) * inverse_root;
    drdE(3 * i + 2) = left(i) * inverse_root;
  }
  SampsonJacobian out;
  out.r = r;
  out.J = drdE * l.dE;
  return out;
}

struct NormalEquations {
  Matrix5 H = Matrix5::Zero();
  Vector5 g = Vector5::Zero();
  double cost = 0.0;
};

NormalEquations build(const RelativePose& pose, AcSpan acs, double scale) {
  const Linearisation linearisation(pose);
  const double s2 = scale * scale;
  NormalEquations n;
  for (const AffineCorrespondence& ac : acs) {
    const SampsonJacobian e = evaluate(linearisation, ac.x1, ac.x2);
    const double r2 = e.r * e.r;
    const double sum = r2 + s2;
    n.cost += r2 / sum;
    const double weight = s2 / (sum * sum);  // ρ'(r) / (2 r)
    n.H.noalias() += weight * e.J.transpose() * e.J;
    n.g.noalias() += weight * e.r * e.J.transpose();
  }
  return n;
}

double cost_only(const RelativePose& pose, AcSpan acs, double scale) {
  const Eigen::Matrix3d E = essential_matrix(pose);
  double cost = 0.0;
  for (const AffineCorrespondence& ac : acs) {
    const double r = sampson_distance(E, ac.x1, ac.x2);
    cost += r * r / (r * r + scale * scale);
  }
  return cost;
}

}  // namespace

SampsonJacobian sampson_jacobian(const RelativePose& pose, const Eigen::Vector2d& x1,
                                 const Eigen::Vector2d& x2) {
  return evaluate(Linearisation(pose), x1, x2);
}

RelativePose retract(const RelativePose& pose, const Vector5& step) {
  RelativePose moved;
  moved.R = rotation_from_vector(step.head<3>()) * pose.R;
  moved.t = (pose.t + tangent_basis(pose.t) * step.tail<2>()).normalized();
  return moved;
}

PolishResult polish(const RelativePose& start, AcSpan acs, const PolishOptions& options) {
  PolishResult result;
  result.pose = {start.R, start.t.normalized()};
  NormalEquations n = build(result.pose, acs, options.threshold);
  result.cost = n.cost;
  double damping = kFirstDamping;
  for (; result.iterations < options.max_iterations; ++result.iterations) {
    Matrix5 H = n.H;
    H.diagonal() += damping * n.H.diagonal() + Vector5::Constant(1e-12);
    const Vector5 step = -H.ldlt().solve(n.g);
    if (!step.allFinite()) break;
    const RelativePose candidate = retract(result.pose, step);
    const double cost = cost_only(candidate, acs, options.threshold);
    if (cost < result.cost) {
      result.pose = candidate;
      damping *= 0.1;
      const bool converged = step.norm() < kConverged || result.cost - cost < 1e-9 * result.cost;
      result.cost = cost;
      if (converged) break;
      n = build(result.pose, acs, options.threshold);
    } else {
      damping *= 10.0;
      if (damping > 1e6) break;
    }
  }
  return result;
}

}  // namespace oneac
