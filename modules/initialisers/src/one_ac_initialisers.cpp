#include "oneac/initialisers/one_ac_initialisers.h"

#include "oneac/base/error.h"
#include "oneac/initialisers/yaml_parameters.h"

#include <mrpt/containers/yaml.h>

#include <stdexcept>

// MRPT's macros name the class in full and must stand outside the namespace.
IMPLEMENTS_VIRTUAL_MRPT_OBJECT(OneAcInitialiser, oneac::RelativePoseInitialiser, oneac)
IMPLEMENTS_MRPT_OBJECT(Initialiser1acPooled, oneac::OneAcInitialiser, oneac)
IMPLEMENTS_MRPT_OBJECT(Initialiser1acGround, oneac::OneAcInitialiser, oneac)
IMPLEMENTS_MRPT_OBJECT(Initialiser1acPlanar, oneac::OneAcInitialiser, oneac)

namespace oneac {

void OneAcInitialiser::configure(const mrpt::containers::yaml& parameters) {
  ConsensusOptions options;
  ParameterTable table;
  table.add("consensus", options);
  apply_yaml(parameters, name(), table);
  try {
    options.validate();
  } catch (const std::invalid_argument& error) {
    throw InputError(name(), error.what(), "correct the value");
  }
  options_ = options;
}

InitialiserResult OneAcInitialiser::estimate(const InitialiserInput& input) const {
  ConsensusOptions options = options_;
  choose_solvers(options);
  InitialiserResult result =
      one_ac_consensus(input.acs, input.R_level_cam, input.focal_px, options);
  MRPT_LOG_DEBUG_FMT("%s: %s, %zu of %zu correspondences agree", name().c_str(),
                     to_string(result.status), result.inlier_count, input.acs.size());
  return result;
}

void Initialiser1acPooled::choose_solvers(ConsensusOptions& options) const {
  options.ground = options.planar = true;
}

void Initialiser1acGround::choose_solvers(ConsensusOptions& options) const {
  options.ground = true;
  options.planar = false;
}

void Initialiser1acPlanar::choose_solvers(ConsensusOptions& options) const {
  options.ground = false;
  options.planar = true;
}

}  // namespace oneac
