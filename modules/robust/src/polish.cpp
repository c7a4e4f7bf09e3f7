#include "oneac/robust/polish.h"

#include "point_arrays.h"

#include <Eigen/Dense>

namespace oneac {
namespace {

using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

constexpr double kFirstDamping = 1e-4;  // of the diagonal; ordinary LM start
constexpr double kLastDamping = 1e6;    // steps so short that nothing is left to gain
// Relative decrease of the cost below which another step is not worth its time.
constexpr double kSmallestGain = 1e-9;

void sums(const internal::ConsensusKernels& kernels, const internal::PoseNumbers<float>& pose,
          const PointSet& points, float squared_scale, internal::NormalSums<float>& out) {
  kernels.normal_sums(pose, internal::arrays_of(points), squared_scale, out);
}

void sums(const internal::ConsensusKernels& kernels, const internal::PoseNumbers<double>& pose,
          const PrecisePointSet& points, double squared_scale, internal::NormalSums<double>& out) {
  kernels.normal_sums_double(pose, internal::arrays_of(points), squared_scale, out);
}

template <class Number>
internal::PoseNumbers<Number> numbers_of(const RelativePose& pose) {
  internal::PoseNumbers<Number> numbers;
  const Eigen::Matrix<double, 3, 2> T = tangent_basis(pose.t);
  for (int i = 0; i < 9; ++i) numbers.R[i] = static_cast<Number>(pose.R(i / 3, i % 3));
  for (int i = 0; i < 3; ++i) {
    numbers.t[i] = static_cast<Number>(pose.t(i));
    numbers.T1[i] = static_cast<Number>(T(i, 0));
    numbers.T2[i] = static_cast<Number>(T(i, 1));
  }
  return numbers;
}

struct NormalEquations {
  Matrix5 H;
  Vector5 g;
  double cost = 0.0;
};

template <class Number>
NormalEquations build(const internal::ConsensusKernels& kernels, const RelativePose& pose,
                      const BasicPointSet<Number>& points, double scale) {
  internal::NormalSums<Number> out;
  sums(kernels, numbers_of<Number>(pose), points, static_cast<Number>(scale * scale), out);
  NormalEquations n;
  n.cost = static_cast<double>(out.cost);
  for (int k = 0, entry = 0; k < 5; ++k) {
    n.g(k) = static_cast<double>(out.g[k]);
    for (int l = k; l < 5; ++l, ++entry) {
      n.H(k, l) = n.H(l, k) = static_cast<double>(out.H[entry]);
    }
  }
  return n;
}

template <class Number>
PolishResult levenberg_marquardt(const RelativePose& start, const BasicPointSet<Number>& points,
                                 const PolishOptions& options) {
  const auto& kernels = internal::consensus_kernels(best_simd_level());
  PolishResult result;
  result.pose = {start.R, start.t.normalized()};
  NormalEquations now = build(kernels, result.pose, points, options.threshold);
  double damping = kFirstDamping;
  for (; result.iterations < options.max_iterations; ++result.iterations) {
    Matrix5 H = now.H;
    H.diagonal() += damping * now.H.diagonal() + Vector5::Constant(1e-12);
    const Vector5 step = -H.ldlt().solve(now.g);
    if (!step.allFinite()) break;
    const RelativePose candidate = retract(result.pose, step);
    const NormalEquations next = build(kernels, candidate, points, options.threshold);
    if (next.cost < now.cost) {
      const bool converged =
          step.norm() < options.converged || now.cost - next.cost < kSmallestGain * now.cost;
      result.pose = candidate;
      now = next;
      damping *= 0.1;
      if (converged) break;
    } else {
      damping *= 10.0;
      if (damping > kLastDamping || step.norm() < options.converged) break;
    }
  }
  result.cost = now.cost;
  result.information = now.H * (options.threshold * options.threshold);
  return result;
}

}  // namespace

Eigen::Matrix<double, 3, 2> tangent_basis(const Eigen::Vector3d& t) {
  Eigen::Index smallest = 0;
  t.cwiseAbs().minCoeff(&smallest);
  Eigen::Matrix<double, 3, 2> T;
  T.col(0) = t.cross(Eigen::Vector3d::Unit(smallest)).normalized();
  T.col(1) = t.cross(T.col(0));
  return T;
}

RelativePose retract(const RelativePose& pose, const Vector5& step) {
  RelativePose moved;
  moved.R = rotation_from_vector(step.head<3>()) * pose.R;
  moved.t = (pose.t + tangent_basis(pose.t) * step.tail<2>()).normalized();
  return moved;
}

PolishResult polish(const RelativePose& start, AcSpan acs, const PolishOptions& options) {
  return levenberg_marquardt(start, PrecisePointSet(acs), options);
}

PolishResult polish(const RelativePose& start, const PrecisePointSet& points,
                    const PolishOptions& options) {
  return levenberg_marquardt(start, points, options);
}

PolishResult polish_coarsely(const RelativePose& start, const PointSet& points,
                             const PolishOptions& options) {
  return levenberg_marquardt(start, points, options);
}

}  // namespace oneac
