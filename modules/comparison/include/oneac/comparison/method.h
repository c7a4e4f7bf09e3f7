#pragma once

#include "oneac/initialisers/relative_pose_initialiser.h"

#include <string>
#include <vector>

namespace oneac {

/// One row of a comparison: an initialiser inside one of its robust estimators.
struct CompareMethod {
  std::string label;        ///< "1ac_pooled"; "1ac_pooled+gc_ransac" when not the default estimator
  std::string initialiser;  ///< see initialiser_names()
  std::string estimator;    ///< one of RelativePoseInitialiser::estimators()
};

/// The methods that two lists of names ask for, in the order of the names.
///
/// @param initialisers  names, or "all"
/// @param estimators    names, "default" (the first one of each initialiser) or "all"; an
///                      initialiser that has none of the named ones is left out
/// @throws InputError for a name that does not exist (the nearest is suggested), or
///         when nothing is left
[[nodiscard]] std::vector<CompareMethod> plan_methods(const std::vector<std::string>& initialisers,
                                                      const std::vector<std::string>& estimators);

/// Makes the initialiser and configures it.
/// @param parameters  YAML with the sections `consensus` and `gc_ransac`; `estimator` is added
/// @throws InputError naming key, value and bound
[[nodiscard]] RelativePoseInitialiser::Ptr make_method(const CompareMethod& method,
                                                       const std::string& parameters);

}  // namespace oneac
