#pragma once

#include "oneac/initialisers/relative_pose_initialiser.h"

#include <cstddef>
#include <exception>
#include <string>

namespace oneac {

/// What is wrong with the answer of an initialiser, which may be anybody's; "" for one that keeps
/// what InitialiserResult promises: a status that exists, R a rotation within 0.001, |t| = 1 or 0
/// as the status says, one inlier flag per correspondence, as many as counted, numbers finite.
/// @param acs  correspondences that it was given
[[nodiscard]] std::string fault_of_answer(const InitialiserResult& answer, std::size_t acs);

/// An answer that can be used.
struct CheckedAnswer {
  InitialiserResult result;  ///< without a pose where there is a fault
  std::string fault;         ///< what was wrong, or thrown; "" as a rule
};

/// Configures, whoever wrote it: what is thrown and is no InputError comes out as one that names
/// the method. @throws InputError
void configure_checked(RelativePoseInitialiser& initialiser,
                       const mrpt::containers::yaml& parameters);

/// What an error of a stranger says, short and printable.
[[nodiscard]] std::string told(const std::exception& error);

/// Asks and checks: what is thrown and what cannot be is no pose, with the reason.
[[nodiscard]] CheckedAnswer checked_answer(const RelativePoseInitialiser& initialiser,
                                           const InitialiserInput& input);

}  // namespace oneac
