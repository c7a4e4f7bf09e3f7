#include "oneac/robust/finite_acs.h"

#include <algorithm>
#include <iterator>

namespace oneac {

FiniteAcs::FiniteAcs(AcSpan all) : all_(all), finite_(all) {
  const auto is_finite = [](const AffineCorrespondence& ac) { return ac.is_finite(); };
  if (std::all_of(all.begin(), all.end(), is_finite)) return;
  copy_.reserve(all.size());
  std::copy_if(all.begin(), all.end(), std::back_inserter(copy_), is_finite);
  finite_ = copy_;
}

std::vector<bool> FiniteAcs::spread(std::vector<bool> of_finite) const {
  if (finite_.size() == all_.size()) return of_finite;
  std::vector<bool> of_all(all_.size(), false);
  for (std::size_t i = 0, k = 0; i < all_.size(); ++i) {
    if (all_[i].is_finite()) of_all[i] = of_finite[k++];
  }
  return of_all;
}

}  // namespace oneac
