#include "oneac/robust/polish.h"

#include "polish/normal_solve.h"
#include "polish/point_arrays.h"

#include <Eigen/Core>

#include <type_traits>

namespace oneac {
namespace {

using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

constexpr double kFirstDamping = 1e-4;  // of the diagonal; ordinary LM start
constexpr double kLastDamping = 1e6;    // steps so short that nothing is left to gain
// Relative decrease of the cost below which another step is not worth its time.
constexpr double kSmallestGain = 1e-9;

/// Whose matrix the normal equations hold.
enum class Curvature {
  kWeights,  ///< Σ ω JᵀJ: never indefinite, the information of the result; converges linearly
  kNewton    ///< the loss's own curvature: converges quadratically, from near enough
};

void sums(const internal::ConsensusKernels& kernels, const internal::PoseNumbers<float>& pose,
          const PointSet& points, float squared_scale, Curvature /*only one*/,
          internal::NormalSums<float>& out) {
  kernels.normal_sums(pose, internal::arrays_of(points), squared_scale, out);
}

void sums(const internal::ConsensusKernels& kernels, const internal::PoseNumbers<double>& pose,
          const PrecisePointSet& points, double squared_scale, Curvature curvature,
          internal::NormalSums<double>& out) {
  const auto kernel =
      curvature == Curvature::kNewton ? kernels.newton_sums : kernels.normal_sums_double;
  kernel(pose, internal::arrays_of(points), squared_scale, out);
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

/// Minimises over the points by Levenberg–Marquardt.
template <class Number>
class Minimiser {
 public:
  Minimiser(const BasicPointSet<Number>& points, const PolishOptions& options)
      : points_(points), options_(options) {}

  [[nodiscard]] PolishResult from(const RelativePose& start, Curvature curvature) {
    result_.pose = {start.R, start.t.normalized()};
    now_ = build(result_.pose, curvature);
    double damping = kFirstDamping;
    bool converged = false;
    for (; !converged && result_.iterations < options_.max_iterations; ++result_.iterations) {
      Vector5 step;
      if (!internal::solve_positive<5>(damped(damping), -now_.g, step)) {
        if (now_.curvature == Curvature::kWeights) break;
        curvature = Curvature::kWeights;
        now_ = build(result_.pose, curvature);
        continue;
      }
      if (!step.allFinite()) break;
      converged = step.norm() < options_.converged;
      // A step that moves the points by less than the loss is wide ends in the basin.
      if (kHasNewton && step.norm() < options_.threshold) curvature = Curvature::kNewton;
      // The matrix of the result is that of the weights.
      if (converged) curvature = Curvature::kWeights;
      const double gain = try_step(step, curvature);
      converged = converged || (gain > 0.0 && gain < kSmallestGain * now_.cost);
      damping *= gain > 0.0 ? 0.1 : 10.0;
      if (damping > kLastDamping) break;
    }
    return conclude();
  }

 private:
  struct NormalEquations {
    Matrix5 H;
    Vector5 g;
    double cost = 0.0;
    Curvature curvature = Curvature::kWeights;
  };

  [[nodiscard]] NormalEquations build(const RelativePose& pose, Curvature curvature) const {
    const double scale = options_.threshold;
    internal::NormalSums<Number> out;
    sums(kernels_, numbers_of<Number>(pose), points_, static_cast<Number>(scale * scale), curvature,
         out);
    NormalEquations n;
    n.curvature = curvature;
    n.cost = static_cast<double>(out.cost);
    for (int k = 0, entry = 0; k < 5; ++k) {
      n.g(k) = static_cast<double>(out.g[k]);
      for (int l = k; l < 5; ++l, ++entry) {
        n.H(k, l) = n.H(l, k) = static_cast<double>(out.H[entry]);
      }
    }
    return n;
  }

  [[nodiscard]] Matrix5 damped(double damping) const {
    Matrix5 H = now_.H;
    H.diagonal() += damping * now_.H.diagonal() + Vector5::Constant(1e-12);
    return H;
  }

  /// Takes the step when the cost falls. Returns by how much, zero or less when it does not.
  [[nodiscard]] double try_step(const Vector5& step, Curvature curvature) {
    const RelativePose candidate = retract(result_.pose, step);
    const NormalEquations next = build(candidate, curvature);
    const double gain = now_.cost - next.cost;
    if (gain > 0.0) {
      result_.pose = candidate;
      now_ = next;
    }
    return gain;
  }

  [[nodiscard]] PolishResult conclude() {
    if (now_.curvature != Curvature::kWeights) now_ = build(result_.pose, Curvature::kWeights);
    result_.cost = now_.cost;
    result_.information = now_.H * (options_.threshold * options_.threshold);
    return result_;
  }

  static constexpr bool kHasNewton = std::is_same_v<Number, double>;
  const internal::ConsensusKernels& kernels_ = internal::simd_kernels<internal::ConsensusKernels>();
  const BasicPointSet<Number>& points_;
  const PolishOptions& options_;
  PolishResult result_;
  NormalEquations now_;
};

}  // namespace

RelativePose retract(const RelativePose& pose, const Vector5& step) {
  RelativePose moved;
  moved.R = rotation_from_vector(step.head<3>()) * pose.R;
  moved.t = (pose.t + tangent_basis(pose.t) * step.tail<2>()).normalized();
  return moved;
}

PolishResult polish(const RelativePose& start, AcSpan acs, const PolishOptions& options) {
  return polish(start, PrecisePointSet(acs), options);
}

PolishResult polish(const RelativePose& start, const PrecisePointSet& points,
                    const PolishOptions& options) {
  const auto first = options.starts_near ? Curvature::kNewton : Curvature::kWeights;
  return Minimiser<double>(points, options).from(start, first);
}

PolishResult polish_coarsely(const RelativePose& start, const PointSet& points,
                             const PolishOptions& options) {
  return Minimiser<float>(points, options).from(start, Curvature::kWeights);
}

}  // namespace oneac
