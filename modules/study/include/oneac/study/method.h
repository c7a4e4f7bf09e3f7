#pragma once

#include "oneac/solvers/homography_decomposition.h"
#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"

#include <string_view>

namespace oneac {

/// Who takes part in the study.
enum class StudyMethod {
  ac1_ground,
  ac1_ground_rapid,
  ac1_front_wall,
  ac1_front_wall_rapid,
  ac1_side_wall,
  ac1_wall,
  pc4,
  ac2,
};

/// How many of a trial's four correspondences a method sees.
enum class DataUse {
  minimal,  ///< as many as it needs, from the first on: 1AC one, 2AC two, 4PC four
  all,      ///< all four, in least squares
};

/// Name in figures and files, e.g. "1AC ground".
[[nodiscard]] std::string_view method_label(StudyMethod method);
/// The solver behind it, as in the registry.
[[nodiscard]] std::string_view method_solver(StudyMethod method);

/// Candidate poses from the four correspondences of a trial. Signs are resolved by cheirality, so
/// up to two remain for 1AC vertical and for both homographies.
[[nodiscard]] SolutionSet<PlanePose, 2> candidates_of(StudyMethod method, AcSpan correspondences,
                                                      DataUse use);

}  // namespace oneac
