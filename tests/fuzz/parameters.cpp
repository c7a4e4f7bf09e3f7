// A YAML file of parameters; what is accepted survives a round trip.
#include "fuzz.h"

#include "oneac/base/error.h"
#include "oneac/initialisers/yaml_parameters.h"
#include "oneac/robust/gc_ransac.h"
#include "oneac/robust/ground_scale.h"
#include "oneac/robust/one_ac_consensus.h"

#include <stdexcept>

ONEAC_FUZZ_TARGET(parameters) {
  using namespace oneac;
  ConsensusOptions consensus;
  GcRansacOptions gc_ransac;
  GroundScaleOptions ground_scale;
  ParameterTable table;
  table.add("consensus", consensus);
  table.add("gc_ransac", gc_ransac);
  table.add("ground_scale", ground_scale);
  try {
    apply_yaml_file(fuzz::file_with(data).string(), table);
    consensus.validate();
    gc_ransac.validate();
    ground_scale.validate();
  } catch (const InputError&) {  // not YAML, unknown keys, other types
    return;
  } catch (const std::invalid_argument&) {  // out of bounds
    return;
  }
  const std::string text = table.to_yaml(true);
  apply_yaml_file(fuzz::file_with(text).string(), table);
  fuzz::check(table.to_yaml(true) == text, "accepted parameters are written as they are read");
}
