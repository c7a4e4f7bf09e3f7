#include "patch_alignment.h"

#include "cholesky.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace oneac::internal {
namespace {

constexpr double kGrey = 16.0;          // pyramid units of one grey level
constexpr double kLeastContrast = 2.0;  // [grey] below it a patch is noise
constexpr int kMaxIterations = 12;
// [px of the level] of centre and rim: what a coarse level and a first round leave to the next one,
// and what is left at last, a tenth of the usual 1σ.
constexpr double kRoughlyConverged = 0.05;
constexpr double kConverged = 0.01;
constexpr double kMaxGain = 2.0;          // and its inverse: exposure steps of one stop
constexpr double kTukey = 4.685;          // [σ] 95 % efficiency under Gaussian noise
constexpr double kMeanAbsolute = 1.2533;  // σ of a normal variable over its mean absolute value
// Noise of smoothed images is correlated between neighbours; what survives the sum over a window is
// the noise before smoothing: 1 / Σ k² of the binomial 3×3 kernel.
constexpr double kCorrelation = 256.0 / 36.0;
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
  SpdInverse<kCount> inverse;
  AlignmentSums sums;
  alignas(64) float residual[kMaxSamples];

  [[nodiscard]] const PatchWindow& window() const { return *patch.window; }

  [[nodiscard]] bool set_weights(const float* weights) {
    weight = weights;
    float upper[kCount * (kCount + 1) / 2];
    const PatchKernels& kernels = patch_kernels();
    if constexpr (kCount == kAffineParameters) {
      kernels.affine_normal(window(), patch.patch, weight, upper);
    } else {
      kernels.translation_normal(window(), patch.patch, weight, upper);
    }
    return inverse.set(upper);
  }

  /// Residuals at the warp; false when the window leaves the image.
  [[nodiscard]] bool look(const PatchWarp& warp) {
    const auto grid = place(image, patch.level, warp, static_cast<double>(window().radius),
                            margin_at(patch.level));
    if (!grid) return false;
    const float gain = static_cast<float>(warp.gain) * patch.patch.contrast;
    const float bias =
        static_cast<float>(warp.gain) * patch.patch.mean + static_cast<float>(warp.bias);
    patch_kernels().residuals(*grid, window(), patch.patch, weight, gain, bias, residual, sums);
    return true;
  }
};

/// W ← W ∘ dW⁻¹ and the photometric part likewise; returns the largest motion of centre and rim
/// [px of the level].
double compose(const AnchoredPatch& patch, const Eigen::Matrix2d& dA, const Eigen::Vector2d& shift,
               double dgain, double dbias, PatchWarp& warp) {
  const double scale = std::ldexp(1.0, static_cast<int>(patch.level));
  warp.M *= (Eigen::Matrix2d::Identity() + dA).inverse();
  warp.centre -= scale * (warp.M * shift);
  // I = gain (contrast T + mean) + bias, and T became (1 + dgain) T + dbias.
  const double contrast = static_cast<double>(patch.patch.contrast);
  const double mean = static_cast<double>(patch.patch.mean);
  const double level_of_grey = warp.gain * mean + warp.bias + warp.gain * contrast * dbias;
  warp.gain = std::clamp(warp.gain * (1.0 + dgain), 1.0 / kMaxGain, kMaxGain);
  warp.bias = level_of_grey - warp.gain * mean;
  return shift.norm() + dA.norm() * static_cast<double>(patch.window->radius);
}

double step(Problem<kAffineParameters>& problem, PatchWarp& warp) {
  double p[kAffineParameters];
  problem.inverse.multiply(problem.sums.gradient, p);
  Eigen::Matrix2d dA;
  dA << p[0], p[1], p[2], p[3];
  dA /= static_cast<double>(problem.window().radius);
  return compose(problem.patch, dA, {p[4], p[5]}, p[6], p[7], warp);
}

double step(Problem<kTranslationParameters>& problem, PatchWarp& warp) {
  double p[kTranslationParameters];
  problem.inverse.multiply(problem.sums.gradient + 4, p);
  return compose(problem.patch, Eigen::Matrix2d::Zero(), {p[0], p[1]}, p[2], p[3], warp);
}

/// Steps until they are small. True also when they are still shrinking at the end: the gates that
/// follow decide. False when the window leaves the image or is torn.
template <std::size_t kCount>
bool iterate(Problem<kCount>& problem, PatchWarp& warp, double converged) {
  const double radius = static_cast<double>(problem.window().radius);
  for (int i = 0; i < kMaxIterations; ++i) {
    if (!problem.look(warp)) return false;
    const double motion = step(problem, warp);
    if (!(motion < 2.0 * radius) || !(warp.M.determinant() > 0.0)) return false;
    if (motion < converged) break;
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
  const double scale = std::ldexp(1.0, static_cast<int>(patch.level));
  quality.affine_sigma =
      residual_sigma * std::sqrt(affine / 4.0) / static_cast<double>(patch.window->radius);
  quality.point_sigma = residual_sigma * std::sqrt(point / 2.0) * scale;
}

/// The second round: weights from the residuals of the first.
bool refine_robustly(Problem<kAffineParameters>& problem, PatchWarp& warp,
                     AlignmentQuality& quality) {
  const PatchWindow& window = problem.window();
  const double sigma = kMeanAbsolute * static_cast<double>(problem.sums.absolute) /
                       static_cast<double>(window.weight_sum);
  alignas(64) float weights[kMaxSamples];
  const double cut = std::max(kTukey * sigma, 1e-6);
  patch_kernels().tukey(window, problem.residual, static_cast<float>(1.0 / cut), weights);
  if (!problem.set_weights(weights) || !iterate(problem, warp, kConverged)) return false;
  float kept = 0.0F;
  for (std::size_t i = 0; i < window.size; ++i) kept += weights[i];
  if (!(kept > 0.5F * window.weight_sum)) return false;
  const double variance = static_cast<double>(problem.sums.squares / kept);
  set_sigmas(problem.inverse, problem.patch, std::sqrt(variance * kCorrelation), quality);
  return true;
}

}  // namespace

bool anchor_patch(const ImagePyramid& pyramid, std::size_t level, const PatchWindow& window,
                  const Eigen::Vector2d& u, AnchoredPatch& patch) {
  PatchWarp here;
  here.centre = u;
  // One pixel more for the gradient.
  const auto grid =
      place(pyramid, level, here, static_cast<double>(window.radius) + 1.0, margin_at(level) + 1.0);
  if (!grid) return false;
  patch.window = &window;
  patch.level = level;
  patch_kernels().make_template(*grid, window, patch.patch);
  // Coarse levels average the texture away: there only what is blank is refused.
  const double least = level == 0 ? kLeastContrast * kGrey : 0.5 * kLeastContrast * kGrey;
  return static_cast<double>(patch.patch.contrast) >= least;
}

bool align_shift(const AnchoredPatch& patch, const ImagePyramid& image, PatchWarp& warp,
                 AlignmentQuality& quality) {
  Problem<kTranslationParameters> problem{patch, image, nullptr, {}, {}, {}};
  if (!problem.set_weights(patch.window->weight) || !iterate(problem, warp, kRoughlyConverged))
    return false;
  quality.zncc = zncc(*patch.window, problem.sums);
  return true;
}

bool align_affine(const AnchoredPatch& patch, const ImagePyramid& image, bool robust,
                  PatchWarp& warp, AlignmentQuality& quality) {
  Problem<kAffineParameters> problem{patch, image, nullptr, {}, {}, {}};
  if (!problem.set_weights(patch.window->weight) || !iterate(problem, warp, kRoughlyConverged))
    return false;
  quality.zncc = zncc(*patch.window, problem.sums);
  return !robust || refine_robustly(problem, warp, quality);
}

double compare_patch(const AnchoredPatch& patch, const ImagePyramid& image, const PatchWarp& warp) {
  Problem<kTranslationParameters> problem{patch, image, patch.window->weight, {}, {}, {}};
  return problem.look(warp) ? zncc(*patch.window, problem.sums) : -1.0;
}

double expected_affine_sigma(const AnchoredPatch& patch) {
  float upper[kAffineParameters * (kAffineParameters + 1) / 2];
  patch_kernels().affine_normal(*patch.window, patch.patch, patch.window->weight, upper);
  SpdInverse<kAffineParameters> inverse;
  if (!inverse.set(upper)) return HUGE_VAL;
  AlignmentQuality quality;
  set_sigmas(inverse, patch, kGrey / static_cast<double>(patch.patch.contrast), quality);
  return quality.affine_sigma;
}

}  // namespace oneac::internal
