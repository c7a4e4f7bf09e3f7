#include "oneac/initialisers/initialiser_options.h"

#include "oneac/base/parameter_table.h"

#include <stdexcept>

namespace oneac {

void InitialiserOptions::validate() const {
  if (estimator != "default" && estimator != "consensus" && estimator != "gc_ransac") {
    throw std::invalid_argument("estimator = " + estimator +
                                ", must be default, consensus or gc_ransac");
  }
  consensus.validate();
  gc_ransac.validate();
}

std::string InitialiserOptions::to_yaml() const {
  InitialiserOptions copy = *this;
  ParameterTable table;
  table.add("", copy);
  return table.to_yaml(false);
}

}  // namespace oneac
