#include "oneac/solvers/batch.h"

#include "batch/batch_kernels.h"

#include "oneac/solvers/relpose_1ac_ground.h"
#include "oneac/solvers/relpose_1ac_planar.h"

#include <stdexcept>
#include <string>

namespace oneac {
namespace {

using internal::BatchKernel;
using Scalar = SolutionSet<PlanarPose, 1> (*)(const AffineCorrespondence&);

/// One solver: its kernel and its scalar form.
struct BatchForm {
  const char* name;
  Scalar scalar;
  BatchKernel internal::BatchKernels::*kernel;
};

constexpr BatchForm kGround{"relpose_1ac_ground_batch", &relpose_1ac_ground,
                            &internal::BatchKernels::ground};
constexpr BatchForm kPlanar{"relpose_1ac_planar_batch", &relpose_1ac_planar,
                            &internal::BatchKernels::planar};

void require(const BatchForm& solver, bool met, const char* what) {
  if (!met) throw std::invalid_argument(std::string(solver.name) + ": " + what);
}

void check(const BatchForm& solver, const AcArrays& acs, const PlanarPoseArrays& poses,
           SimdLevel level) {
  require(solver, is_supported(level), "level: this processor does not have it, see is_supported");
  if (acs.size == 0) return;
  const bool in = acs.x1 != nullptr && acs.y1 != nullptr && acs.x2 != nullptr &&
                  acs.y2 != nullptr && acs.a11 != nullptr && acs.a12 != nullptr &&
                  acs.a21 != nullptr && acs.a22 != nullptr;
  require(solver, in, "acs: a null array although size > 0");
  const bool out = poses.cos_alpha != nullptr && poses.sin_alpha != nullptr &&
                   poses.tx != nullptr && poses.tz != nullptr && poses.valid != nullptr;
  require(solver, out, "poses: a null array although size > 0");
}

[[nodiscard]] AffineCorrespondence entry(const AcArrays& acs, std::size_t i) {
  AffineCorrespondence ac;
  ac.x1 << acs.x1[i], acs.y1[i];
  ac.x2 << acs.x2[i], acs.y2[i];
  ac.A << acs.a11[i], acs.a12[i], acs.a21[i], acs.a22[i];
  return ac;
}

/// What the kernel would not decide. Its lanes have the identity written already.
void decide(Scalar scalar, const AcArrays& acs, const PlanarPoseArrays& poses, std::size_t i) {
  const SolutionSet<PlanarPose, 1> found = scalar(entry(acs, i));
  poses.valid[i] = found.empty() ? 0 : 1;
  if (found.empty()) return;
  poses.cos_alpha[i] = found[0].cos_alpha;
  poses.sin_alpha[i] = found[0].sin_alpha;
  poses.tx[i] = found[0].tx;
  poses.tz[i] = found[0].tz;
}

std::size_t solve(const BatchForm& solver, const AcArrays& acs, const PlanarPoseArrays& poses,
                  SimdLevel level) {
  check(solver, acs, poses, level);
  const internal::BatchInput in{
      {acs.x1, acs.y1, acs.x2, acs.y2, acs.a11, acs.a12, acs.a21, acs.a22}};
  const internal::BatchOutput out{{poses.cos_alpha, poses.sin_alpha, poses.tx, poses.tz},
                                  poses.valid};
  (internal::simd_kernels<internal::BatchKernels>(level).*solver.kernel)(in, out, acs.size);
  std::size_t valid = 0;
  for (std::size_t i = 0; i < acs.size; ++i) {
    if (poses.valid[i] == internal::kBatchUndecided) decide(solver.scalar, acs, poses, i);
    valid += poses.valid[i];
  }
  return valid;
}

}  // namespace

std::size_t relpose_1ac_ground_batch(const AcArrays& acs, const PlanarPoseArrays& poses,
                                     SimdLevel level) {
  return solve(kGround, acs, poses, level);
}

std::size_t relpose_1ac_planar_batch(const AcArrays& acs, const PlanarPoseArrays& poses,
                                     SimdLevel level) {
  return solve(kPlanar, acs, poses, level);
}

}  // namespace oneac
