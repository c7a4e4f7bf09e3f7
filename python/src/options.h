#pragma once

#include "oneac/base/parameter_table.h"

#include <pybind11/pybind11.h>

#include <string>

namespace oneac::python {

/// Sets parameters from keyword arguments; sections are nested dicts: tilt={"source": "drive"}.
/// @param prefix  of the keys, "" or "section."
/// @throws std::invalid_argument for unknown keys (the nearest is suggested) and wrong types
void set_parameters(const pybind11::dict& values, const std::string& prefix, ParameterTable& table);

/// An option struct with these keyword arguments, within its bounds.
/// @throws std::invalid_argument as set_parameters(), and out of bounds
template <class Options>
[[nodiscard]] Options options_from(const pybind11::dict& values) {
  Options options;
  ParameterTable table;
  table.add("", options);
  set_parameters(values, "", table);
  options.validate();
  return options;
}

}  // namespace oneac::python
