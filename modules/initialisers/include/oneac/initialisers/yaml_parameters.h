#pragma once

#include "oneac/base/parameter_table.h"

#include <string>

namespace mrpt::containers {
class yaml;
}

namespace oneac {

/// Sets the table's parameters from a YAML map of sections and values.
/// @param origin  named in messages, e.g. the file
/// @throws InputError for unknown keys (nearest suggested), wrong types and anything
///         but maps of scalars
void apply_yaml(const mrpt::containers::yaml& document, const std::string& origin,
                ParameterTable& table);

/// The same from a file. @throws InputError when it is missing or not YAML
void apply_yaml_file(const std::string& path, ParameterTable& table);

}  // namespace oneac
