#include "perspective_correction.h"

#include "oneac/geometry/perspective.h"

namespace oneac {
namespace {

// [-] 1σ of an entry of A whose track does not say.
constexpr double kAffineSigma = 0.05;

}  // namespace

TrackedPair corrected_for_perspective(const RelativePose& T_2_1, TrackedPair pair) {
  for (Correspondence& ac : pair.correspondences) {
    if (ac.perspective.isZero(0.0)) continue;
    const double sigma = ac.affine_sigma > 0.0 ? ac.affine_sigma : kAffineSigma;
    const auto eta = perspective_of(ac, T_2_1, sigma);
    if (!eta) continue;
    ac.moved = ac.A * (ac.perspective * *eta);
    ac.x2 += ac.moved;
  }
  return pair;
}

}  // namespace oneac
