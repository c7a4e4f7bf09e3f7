#include "oneac/study/method.h"

#include <cstddef>
#include <stdexcept>
#include <string>

namespace oneac {

StudyMethod study_method(std::string_view name) {
  const Solver& solver = solver_named(name);
  if (solver.run.least_squares != nullptr) return &solver;
  throw std::invalid_argument("method = " + std::string(name) + ", must have a least-squares form");
}

PoseSet candidates_of(StudyMethod method, AcSpan correspondences, DataUse use) {
  if (correspondences.size() < method->sample) return {};
  const std::size_t used = use == DataUse::kAll ? correspondences.size() : method->sample;
  return method->run.least_squares(AcSpan(correspondences.begin(), used));
}

}  // namespace oneac
