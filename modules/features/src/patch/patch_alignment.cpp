#include "patch_alignment.h"

#include "patch_perspective.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace oneac::internal {
namespace {

constexpr double kGrey = PyramidLevel::kPerGrey;
constexpr double kLeastContrast = 2.0 * kGrey;  // below it a patch is noise
// Steps shrink to a half or faster where the texture determines them: from 3 px to 0.1 px in five.
constexpr int kMaxShiftIterations = 8;
constexpr int kMaxAffineIterations = 12;
// [px of the level] of centre and rim: the step not taken any more. A coarse level and a first
// round leave a thirtieth of what the next one captures, the last round a tenth of the usual 1σ.
constexpr double kRoughlyConverged = 0.1;
constexpr double kConverged = 0.01;
constexpr double kMaxGain = 2.0;          // and its inverse: exposure steps of one stop
constexpr double kTukey = 4.685;          // [σ] 95 % efficiency under Gaussian noise
constexpr double kMeanAbsolute = 1.2533;  // σ of a normal variable over its mean absolute value
// Smoothing correlates the noise of neighbours; what survives the sum over a window is the noise
// before it: 1 / Σ k² of the binomial 3×3 kernel. Every second row alone carries half as much: each
// row of the image has the same weight in their sum, (1 + 1) / 4 or 2 / 4.
constexpr double kCorrelation = 256.0 / 36.0;
// [-] Of what a patch tells along an axis, where noise has it all: the axis counts for nothing.
constexpr double kLeastLeft = 0.05;

double noise_share(const PatchWindow& window) {
  return 1.0 / static_cast<double>(window.row_step);
}
// The border is made up; windows of coarse levels may reach into it, those of level 0 must not.
constexpr double kCoarseMargin = 12.0;

double margin_at(std::size_t level) {
  return level == 0 ? -2.0 : kCoarseMargin;
}

/// Everything that one alignment works with.
template <std::size_t kCount>
struct Problem {
  const AnchoredPatch& patch;
  const ImagePyramid& image;
  const float* weight;
  float normal[kCount * (kCount + 1) / 2];  ///< upper triangle, row by row
  SpdInverse<kCount> inverse{};
  AlignmentSums sums{};
  alignas(64) float residual[kMaxSamples];

  Problem(const AnchoredPatch& anchored, const ImagePyramid& other)
      : patch(anchored), image(other), weight(anchored.window->weight) {}

  [[nodiscard]] const PatchWindow& window() const { return *patch.window; }

  [[nodiscard]] bool set_weights(const float* weights) {
    weight = weights;
    const PatchKernels& kernels = simd_kernels<PatchKernels>();
    if constexpr (kCount == kAffineParameters) {
      kernels.affine_normal(window(), patch.patch, weight, normal);
    } else {
      kernels.translation_normal(window(), patch.patch, weight, normal);
    }
    return inverse.set(normal);
  }

  /// Residuals at the warp; false when the window leaves the image.
  [[nodiscard]] bool look(const PatchWarp& warp) {
    PatchWarp looked = warp;
    if constexpr (kCount == kTranslationParameters) looked.M.setIdentity();
    const auto grid = place(image, patch.level, looked, static_cast<double>(window().radius),
                            margin_at(patch.level));
    if (!grid) return false;
    const float gain = static_cast<float>(warp.gain) * patch.patch.contrast;
    const float bias =
        static_cast<float>(warp.gain) * patch.patch.mean + static_cast<float>(warp.bias);
    const PatchKernels& kernels = simd_kernels<PatchKernels>();
    if constexpr (kCount == kTranslationParameters) {
      kernels.shift_residuals(*grid, window(), patch.patch, gain, bias, sums);
    } else {
      kernels.residuals(*grid, window(), patch.patch, weight, gain, bias, residual, sums);
    }
    return true;
  }
};

/// The photometric part of W ← W ∘ dW⁻¹.
void compose_light(const AnchoredPatch& patch, double dgain, double dbias, PatchWarp& warp) {
  // I = gain (contrast T + mean) + bias, and T became (1 + dgain) T + dbias.
  const double contrast = static_cast<double>(patch.patch.contrast);
  const double mean = static_cast<double>(patch.patch.mean);
  const double level_of_grey = warp.gain * mean + warp.bias + warp.gain * contrast * dbias;
  warp.gain = std::clamp(warp.gain * (1.0 + dgain), 1.0 / kMaxGain, kMaxGain);
  warp.bias = level_of_grey - warp.gain * mean;
}

/// W ← W ∘ dW⁻¹; returns the largest motion of centre and rim [px of the level].
double step(Problem<kAffineParameters>& problem, PatchWarp& warp) {
  double p[kAffineParameters];
  problem.inverse.multiply(problem.sums.gradient, p);
  Eigen::Matrix2d dA;
  dA << p[0], p[1], p[2], p[3];
  const double rim = dA.norm();
  dA /= static_cast<double>(problem.window().radius);
  const Eigen::Vector2d shift(p[4], p[5]);
  warp.M *= (Eigen::Matrix2d::Identity() + dA).inverse();
  warp.centre -= level_scale(problem.patch.level) * (warp.M * shift);
  compose_light(problem.patch, p[6], p[7], warp);
  return shift.norm() + rim;
}

double step(Problem<kTranslationParameters>& problem, PatchWarp& warp) {
  double p[kTranslationParameters];
  problem.inverse.multiply(problem.sums.gradient + 4, p);
  const Eigen::Vector2d shift(p[0], p[1]);
  warp.centre -= level_scale(problem.patch.level) * shift;
  compose_light(problem.patch, p[2], p[3], warp);
  return shift.norm();
}

/// Steps until the next one would be small: steps shrink by about the same `rate`, which the second
/// round of a patch takes over from the first. True also when they still shrink at the end: the
/// gates that follow decide. False when the window leaves the image or is torn.
template <std::size_t kCount>
bool iterate(Problem<kCount>& problem, PatchWarp& warp, double converged, double& rate) {
  const double radius = static_cast<double>(problem.window().radius);
  constexpr int kMaxIterations =
      kCount == kTranslationParameters ? kMaxShiftIterations : kMaxAffineIterations;
  double last = 0.0;
  for (int i = 0; i < kMaxIterations; ++i) {
    if (!problem.look(warp)) return false;
    const double motion = step(problem, warp);
    if (!(motion < 2.0 * radius) || !(warp.M.determinant() > 0.0)) return false;
    if (last > 0.0) rate = motion / last;
    if (motion < converged || motion * rate < converged) break;
    last = motion;
  }
  return true;
}

double zncc(const PatchWindow& window, const AlignmentSums& sums) {
  const auto total = static_cast<double>(window.weight_sum);
  const auto with_template = static_cast<double>(sums.gradient[6]);
  const auto mean = static_cast<double>(sums.gradient[7]);
  const double variance =
      total + 2.0 * with_template + static_cast<double>(sums.squares) - mean * mean / total;
  return variance > 0.0 ? (total + with_template) / std::sqrt(total * variance) : -1.0;
}

/// Root mean square σ of A and of the point from the inverse normal matrix, for residuals of 1.
void set_sigmas(const SpdInverse<kAffineParameters>& inverse, const AnchoredPatch& patch,
                double residual_sigma, AlignmentQuality& quality) {
  double affine = 0.0;
  for (std::size_t k = 0; k < 4; ++k) affine += inverse(k, k);
  const double point = inverse(4, 4) + inverse(5, 5);
  const double scale = level_scale(patch.level);
  quality.affine_sigma =
      residual_sigma * std::sqrt(affine / 4.0) / static_cast<double>(patch.window->radius);
  quality.point_sigma = residual_sigma * std::sqrt(point / 2.0) * scale;
}

/// Variance that noise gives a component of the template's gradient: half of that of the
/// residuals', as the other image has as much. Noise is rough; what the warp does not explain is
/// smooth.
double gradient_noise(const PatchWindow& window, const float* weight, const float* residual) {
  double squares = 0.0, weights = 0.0;
  for (std::size_t i = 1; i + 1 < window.size; ++i) {
    const bool in_a_row = window.x[i + 1] - window.x[i - 1] == 2.0F;
    if (!in_a_row || weight[i - 1] == 0.0F || weight[i + 1] == 0.0F) continue;
    const auto slope = 0.5 * static_cast<double>(residual[i + 1] - residual[i - 1]);
    squares += static_cast<double>(weight[i]) * slope * slope;
    weights += static_cast<double>(weight[i]);
  }
  return weights > 0.0 ? 0.5 * squares / weights : 0.0;
}

/// By how much noise in the gradient raises the variance of the point. A smooth slope under noise
/// has the gradient of a corner, and determines nothing across it: from the point's information,
/// along both of its axes, goes what noise alone adds (Fuller, Measurement Error Models, section
/// 2.2: least squares with a noisy Jacobian, N⁻¹ becomes (N − D)⁻¹ N (N − D)⁻¹).
/// @param noise  what noise adds to the normal matrix at the two diagonal entries of the point
double growth_by_noise(const SpdInverse<kAffineParameters>& inverse, double noise) {
  Eigen::Matrix2d covariance;
  covariance << inverse(4, 4), inverse(4, 5), inverse(5, 4), inverse(5, 5);
  const double middle = 0.5 * covariance.trace();
  const double half = std::sqrt(std::max(0.0, middle * middle - covariance.determinant()));
  double variance = 0.0;
  for (const double along : {middle + half, middle - half}) {
    const double left = std::max(1.0 - noise * along, kLeastLeft);
    variance += along / (left * left);
  }
  return variance / (2.0 * middle);
}

/// The second round: weights from the residuals of the first.
bool refine_robustly(Problem<kAffineParameters>& problem, PatchWarp& warp, double rate,
                     AlignmentQuality& quality) {
  const PatchWindow& window = problem.window();
  const double sigma = kMeanAbsolute * static_cast<double>(problem.sums.absolute) /
                       static_cast<double>(window.weight_sum);
  alignas(64) float weights[kMaxSamples];
  const double cut = std::max(kTukey * sigma, 1e-6);
  simd_kernels<PatchKernels>().tukey(window, problem.residual, static_cast<float>(1.0 / cut),
                                     weights);
  if (!problem.set_weights(weights) || !iterate(problem, warp, kConverged, rate)) return false;
  float kept = 0.0F;
  for (std::size_t i = 0; i < window.size; ++i) kept += weights[i];
  if (!(kept > 0.5F * window.weight_sum)) return false;
  const double variance = static_cast<double>(problem.sums.squares / kept);
  const double noise =
      static_cast<double>(kept) * gradient_noise(window, weights, problem.residual);
  set_sigmas(problem.inverse, problem.patch,
             std::sqrt(variance * kCorrelation * noise_share(window)), quality);
  quality.point_sigma *= std::sqrt(growth_by_noise(problem.inverse, noise));
  const double radius = static_cast<double>(window.radius) * level_scale(problem.patch.level);
  quality.perspective = perspective_shift(problem.normal, radius);
  return true;
}

}  // namespace

bool anchor_patch(const ImagePyramid& pyramid, std::size_t level, const PatchWindow& window,
                  const PatchWarp& here, AnchoredPatch& patch) {
  patch.window = &window;
  patch.level = level;
  patch.M = here.M;
  patch.inverted = false;
  // One pixel more for the gradient.
  const auto grid =
      place(pyramid, level, here, static_cast<double>(window.radius) + 1.0, margin_at(level) + 1.0);
  if (!grid) return false;
  simd_kernels<PatchKernels>().make_template(*grid, window, patch.patch);
  // Coarse levels average the texture away: there only what is blank is refused.
  return static_cast<double>(patch.patch.contrast) >= (level == 0 ? 1.0 : 0.5) * kLeastContrast;
}

bool anchor_patch(const ImagePyramid& pyramid, std::size_t level, const PatchWindow& window,
                  const Eigen::Vector2d& u, AnchoredPatch& patch) {
  PatchWarp here;
  here.centre = u;
  return anchor_patch(pyramid, level, window, here, patch);
}

bool align_shift(const AnchoredPatch& patch, const ImagePyramid& image, PatchWarp& warp,
                 AlignmentQuality& quality) {
  Problem<kTranslationParameters> problem(patch, image);
  double rate = HUGE_VAL;
  if (!problem.set_weights(patch.window->weight) ||
      !iterate(problem, warp, kRoughlyConverged, rate))
    return false;
  quality.zncc = zncc(*patch.window, problem.sums);
  return true;
}

bool align_affine(const AnchoredPatch& patch, const ImagePyramid& image, bool robust,
                  PatchWarp& warp, AlignmentQuality& quality) {
  Problem<kAffineParameters> problem(patch, image);
  if (patch.inverted) {
    problem.inverse = patch.inverse;
  } else if (!problem.set_weights(patch.window->weight)) {
    return false;
  }
  double rate = HUGE_VAL;
  if (!iterate(problem, warp, kRoughlyConverged, rate)) return false;
  quality.zncc = zncc(*patch.window, problem.sums);
  return !robust || refine_robustly(problem, warp, rate, quality);
}

double compare_patch(const AnchoredPatch& patch, const ImagePyramid& image, const PatchWarp& warp) {
  Problem<kAffineParameters> problem(patch, image);
  return problem.look(warp) ? zncc(*patch.window, problem.sums) : -1.0;
}

double expected_affine_sigma(AnchoredPatch& patch) {
  float upper[kAffineParameters * (kAffineParameters + 1) / 2];
  simd_kernels<PatchKernels>().affine_normal(*patch.window, patch.patch, patch.window->weight,
                                             upper);
  patch.inverted = patch.inverse.set(upper);
  if (!patch.inverted) return HUGE_VAL;
  AlignmentQuality quality;
  const double sigma = kGrey / static_cast<double>(patch.patch.contrast);
  set_sigmas(patch.inverse, patch, sigma * std::sqrt(noise_share(*patch.window)), quality);
  return quality.affine_sigma;
}

}  // namespace oneac::internal
