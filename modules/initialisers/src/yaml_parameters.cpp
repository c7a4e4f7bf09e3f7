#include "oneac/initialisers/yaml_parameters.h"

#include "oneac/base/error.h"

#include <mrpt/containers/yaml.h>
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <stdexcept>

namespace oneac {
namespace {

constexpr const char* kCure = "see params/default.yaml for all keys";

void apply_map(const mrpt::containers::yaml::map_t& map, const std::string& prefix,
               ParameterTable& table) {
  for (const auto& [key_node, value] : map) {
    const std::string key = prefix + key_node.as<std::string>();
    if (value.isMap()) {
      apply_map(value.asMap(), key + ".", table);
    } else if (value.isScalar()) {
      table.set(key, value.as<std::string>());
    } else {
      throw std::invalid_argument("key '" + key + "' must be a single value");
    }
  }
}

/// "params.yaml: line 3": where a node of a file stands.
std::string place(const std::string& path, const YAML::Mark& mark) {
  return mark.is_null() ? path : path + ": line " + std::to_string(mark.line + 1);
}

void apply_node(const YAML::Node& map, const std::string& path, const std::string& prefix,
                ParameterTable& table) {
  for (const auto& entry : map) {
    const std::string key = prefix + entry.first.Scalar();
    try {
      if (entry.second.IsMap()) {
        apply_node(entry.second, path, key + ".", table);
      } else if (entry.second.IsScalar()) {
        table.set(key, entry.second.Scalar());
      } else {
        throw std::invalid_argument("key '" + key + "' must have a single value");
      }
    } catch (const std::invalid_argument& error) {
      throw InputError(place(path, entry.first.Mark()), error.what(), kCure);
    }
  }
}

}  // namespace

void apply_yaml(const mrpt::containers::yaml& document, const std::string& origin,
                ParameterTable& table) {
  if (document.isNullNode()) return;  // nothing overrides nothing
  try {
    if (!document.isMap()) throw std::invalid_argument("not a map of keys and values");
    apply_map(document.asMap(), "", table);
  } catch (const std::invalid_argument& error) {
    throw InputError(origin, error.what(), kCure);
  }
}

void apply_yaml_file(const std::string& path, ParameterTable& table) {
  if (!std::filesystem::is_regular_file(path)) {
    throw InputError(path, "no such parameter file", "check the path after --params");
  }
  YAML::Node document;
  try {
    document = YAML::LoadFile(path);
  } catch (const YAML::Exception& error) {
    throw InputError(place(path, error.mark), "is not valid YAML (" + error.msg + ")", kCure);
  }
  if (document.IsNull()) return;
  if (!document.IsMap()) throw InputError(path, "is not a map of keys and values", kCure);
  apply_node(document, path, "", table);
}

}  // namespace oneac
