#pragma once

#include "arrays.h"

#include "oneac/solvers/registry.h"

#include <string>

namespace oneac::python {

/// What help() says of a solver: the comment of its header, then shapes and units.
[[nodiscard]] std::string docstring_of(const Solver& solver);
/// That x1 has this shape, and the two that the solver takes.
[[nodiscard]] std::string fault_of_samples(const Solver& solver, const Shape& given);
/// The shape of points whose other axes these are.
[[nodiscard]] Shape with_points(Shape shape);

}  // namespace oneac::python
