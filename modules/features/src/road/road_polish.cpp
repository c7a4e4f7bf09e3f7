#include "road_polish.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace oneac::internal {
namespace {

constexpr int kSteps = 4;  // a level; most take two or three
// Lines along the road that are used: more of them see the same errors of road and camera.
constexpr int kFineStride = 2, kCoarseStride = 4;
constexpr double kConverged = 0.1;  // [σ] of a step along the length
constexpr double kSettled = 0.5;    // [σ] of the last one: good enough, σ grows by a tenth
constexpr double kCauchy = 2.0;     // [σ] a block's deviation that halves its weight ...
constexpr double kAgrees = 3.0;     // [σ] ... and that is another opinion
// Residuals are correlated across lines too, and a pixel is met by more than one sample.
constexpr double kAcross = 1.5;
constexpr double kMostCorrelated = 0.95;  // [-] lag beyond which it is not taken at its word

/// Samples per independent one, from how residuals of neighbours hang together.
double redundancy(const RoadEquations& equations) {
  double lag = 0.0, samples = 0.0;
  for (const BlockEquations& block : equations) {
    lag += block.lag * block.samples;
    samples += block.samples;
  }
  lag = samples > 0.0 ? std::clamp(lag / samples, 0.0, kMostCorrelated) : 0.0;
  return kAcross * (1.0 + lag) / (1.0 - lag);
}

/// Precision of a block's sums: of its pixels, limited by the road's unevenness.
double precision_of(const BlockEquations& block, double redundant, double uneven) {
  if (!(block.H(0, 0) > 0.0) || !(block.variance > 0.0)) return 0.0;
  const double pixels = 1.0 / (block.variance * redundant);
  return pixels / (1.0 + block.H(0, 0) * pixels * uneven * uneven);
}

/// The prior and the heave at the state, added to the normal equations.
void add_prior(const RoadPrior& prior, const RoadMotion& motion, const RoadVector& z, RoadMatrix& H,
               RoadVector& g) {
  H += prior.information;
  g += prior.information * z;
  RoadVector row = RoadVector::Zero();
  row(0) = motion.n.dot(motion.s);
  row.segment<2>(1) = motion.length * prior.tangents.normal.transpose() * motion.s;
  row.segment<3>(3) = motion.length * motion.n.cross(motion.s);
  row.segment<2>(6) = motion.length * prior.tangents.travel.transpose() * motion.n;
  const double rise = motion.length * row(0), precision = 1.0 / (prior.heave * prior.heave);
  H += precision * row * row.transpose();
  g += precision * rise * row;
}

/// One block's own length against that of all, in its own σ.
void weigh_blocks(double redundant, double uneven, const RoadAlignmentOptions& options,
                  const RoadVector& step, RoadFit& fit) {
  double evidence = 0.0, agreeing = 0.0, chi2 = 0.0;
  fit.blocks = 0;
  for (std::size_t i = 0; i < kBlocks; ++i) {
    const BlockEquations& block = fit.equations[i];
    const double precision = precision_of(block, redundant, uneven);
    fit.weight[i] = fit.evidence[i] = 0.0;
    if (!(precision > 0.0) || block.rho < options.min_correlation) continue;
    const double information = precision * block.H(0, 0);
    // What the block wants beyond the step that all of them take.
    const RoadVector rest = block.g + block.H * step;
    fit.deviation[i] = -rest(0) / block.H(0, 0) * std::sqrt(information);
    const double scaled = fit.deviation[i] / kCauchy;
    fit.weight[i] = 1.0 / (1.0 + scaled * scaled);
    fit.evidence[i] = fit.weight[i] * information;
    evidence += information;
    if (std::abs(fit.deviation[i]) > kAgrees) continue;
    agreeing += information;
    chi2 += fit.deviation[i] * fit.deviation[i];
    ++fit.blocks;
  }
  fit.agreeing = evidence > 0.0 ? agreeing / evidence : 0.0;
  fit.scatter = fit.blocks > 1 ? std::max(1.0, chi2 / (fit.blocks - 1)) : 1.0;
}

/// One Gauss-Newton step; the step, or a NaN-free zero when there is nothing to solve.
RoadVector solve_step(const RoadPrior& prior, double redundant, double uneven, RoadFit& fit) {
  RoadMatrix H = RoadMatrix::Zero();
  RoadVector g = RoadVector::Zero();
  for (std::size_t i = 0; i < kBlocks; ++i) {
    const double precision = fit.weight[i] * precision_of(fit.equations[i], redundant, uneven);
    H += precision * fit.equations[i].H;
    g += precision * fit.equations[i].g;
  }
  add_prior(prior, fit.motion, fit.z, H, g);
  const Eigen::LDLT<RoadMatrix> factor(H);
  RoadVector step = -factor.solve(g);
  if (factor.info() != Eigen::Success || !step.allFinite()) return RoadVector::Zero();
  fit.covariance = factor.solve(RoadMatrix::Identity());
  return step;
}

/// Iterates at one level. @return the last step was small
bool polish_level(const RoadContext& context, const RoadGrid& grid, std::size_t level,
                  const RoadPrior& prior, const RoadAlignmentOptions& options, RoadFit& fit) {
  const RoadLook<GreySample> look{level, template_samples(context, grid, level),
                                  options.noise_grey / static_cast<double>(1U << level),
                                  level == 0 ? kFineStride : kCoarseStride};
  for (BlockEquations& block : fit.equations) block.variance = 0.0;
  double size = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    fit.equations = road_equations(context, grid, look, fit.motion, prior.tangents, fit.equations);
    const double redundant = redundancy(fit.equations);
    const double uneven = options.unevenness * std::max(fit.motion.length, 0.05);
    RoadVector step = solve_step(prior, redundant, uneven, fit);
    weigh_blocks(redundant, uneven, options, step, fit);
    step = solve_step(prior, redundant, uneven, fit);
    fit.z += step;
    fit.motion = moved(prior.start, prior.tangents, fit.z);
    size = std::abs(step(0)) / std::sqrt(std::max(fit.covariance(0, 0), 1e-12));
    if (size < kConverged) return true;
  }
  return size < kSettled;
}

}  // namespace

RoadFit polish(const RoadContext& context, const RoadGrid& grid, std::size_t coarsest,
               const RoadPrior& prior, const RoadPeak& peak, const RoadAlignmentOptions& options) {
  RoadFit fit;
  fit.z(0) = peak.length - prior.start.length;
  fit.motion = moved(prior.start, prior.tangents, fit.z);
  fit.weight.fill(1.0);
  for (std::size_t level = coarsest + 1; level-- > 0;) {
    fit.converged = polish_level(context, grid, level, prior, options, fit);
    if (std::abs(fit.motion.length - peak.length) > peak.reach) {
      fit.converged = false;
      return fit;
    }
  }
  return fit;
}

}  // namespace oneac::internal
