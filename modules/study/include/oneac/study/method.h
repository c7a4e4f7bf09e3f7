#pragma once

#include "oneac/solvers/registry.h"
#include "oneac/solvers/span.h"

#include <string_view>

namespace oneac {

/// Who takes part in the study: a row of the list of solvers that has a least-squares form.
using StudyMethod = const Solver*;

/// @throws std::invalid_argument for a name that no such solver has
[[nodiscard]] StudyMethod study_method(std::string_view name);

/// The planar solver as Hajder and Barath and Guan et al. pose it: the two angles for unknowns,
/// both unit circles as constraints, the three equations of each correspondence in least squares.
/// Written anew, the minimum found on a grid; a rival of the study, no row of the list.
[[nodiscard]] StudyMethod planar_two_circles();

/// How many of a trial's four correspondences a method sees.
enum class DataUse {
  kMinimal,  ///< as many as it needs, from the first on: 1AC one, 2AC two, 4PC four
  kAll,      ///< all four, in least squares
};

/// Candidate poses from the four correspondences of a trial. Signs are resolved by cheirality, so
/// up to two remain for 1AC wall and for both homographies.
[[nodiscard]] PoseSet candidates_of(StudyMethod method, AcSpan correspondences, DataUse use);

}  // namespace oneac
