#include "oneac/solvers/relpose_1ac_planar.h"

#include "math/usable.h"
#include "planes/planar_entries.h"

namespace oneac {

SolutionSet<PlanarPose, 1> relpose_1ac_planar(const AffineCorrespondence& ac) {
  if (!internal::is_usable(ac)) return {};
  const auto e = internal::entries_of(ac);
  if (!e) return {};
  return internal::with_sign(internal::pose_from_entries(*e), AcSpan(&ac, 1), nullptr,
                             internal::EpipolarRows::kAffine);
}

SolutionSet<PlanarPose, 1> relpose_nac_planar(AcSpan acs, const double* weights) {
  if (acs.size() == 1 && weights == nullptr)
    return relpose_1ac_planar(acs[0]);  // the minors keep twice the digits
  const auto e = internal::entries_of(acs, weights);
  if (!e) return {};
  return internal::with_sign(internal::pose_from_entries(*e), acs, weights,
                             internal::EpipolarRows::kAffine);
}

}  // namespace oneac
