#pragma once

#include "oneac/base/bound.h"
#include "oneac/robust/gc_ransac.h"
#include "oneac/robust/one_ac_consensus.h"

#include <string>

namespace oneac {

/// What the initialisers of this library can be told. validate() throws std::invalid_argument.
struct InitialiserOptions {
  std::string estimator = "default";  ///< "consensus", "gc_ransac", or what the method prefers
  ConsensusOptions consensus;
  GcRansacOptions gc_ransac;

  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
  /// As a YAML document, for RelativePoseInitialiser::configure.
  [[nodiscard]] std::string to_yaml() const;
};

template <class Visitor>
void describe(Visitor&& visit, InitialiserOptions& o) {
  visit("estimator", o.estimator, "name", "default: the method's own",
        Bound::one_of("default, consensus or gc_ransac"));
  visit.section("consensus", o.consensus);
  visit.section("gc_ransac", o.gc_ransac);
}

}  // namespace oneac
