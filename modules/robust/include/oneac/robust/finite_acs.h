#pragma once

#include "oneac/solvers/span.h"

#include <vector>

namespace oneac {

/// Those of the correspondences that are finite, in their order: estimators take no others. Nothing
/// is copied where all are.
/// @pre the correspondences outlive it
class FiniteAcs {
 public:
  explicit FiniteAcs(AcSpan all);
  FiniteAcs(const FiniteAcs&) = delete;
  FiniteAcs& operator=(const FiniteAcs&) = delete;

  [[nodiscard]] AcSpan acs() const { return finite_; }
  /// Flags of the finite ones, put back in the places of all; the others have false.
  [[nodiscard]] std::vector<bool> spread(std::vector<bool> of_finite) const;

 private:
  AcSpan all_, finite_;
  std::vector<AffineCorrespondence> copy_;
};

}  // namespace oneac
