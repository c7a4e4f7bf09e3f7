#include "oneac/initialisers/initialiser_options.h"

#include "oneac/base/check_bounds.h"
#include "oneac/base/parameter_table.h"

namespace oneac {

void InitialiserOptions::validate() const {
  check_bounds("", *this);
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
