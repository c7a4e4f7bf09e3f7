#include "oneac/initialisers/yaml_parameters.h"

#include "oneac/base/error.h"
#include "oneac/base/input_file.h"

#include <mrpt/containers/yaml.h>
#include <yaml-cpp/yaml.h>

#include <cstddef>
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

/// Walks a document into a table. Anchors let a few lines of YAML nest or repeat without end.
class FileWalk {
 public:
  FileWalk(const std::string& path, ParameterTable& table) : path_(path), table_(table) {}

  void apply(const YAML::Node& map, const std::string& prefix, std::size_t depth) {
    for (const auto& entry : map) {
      try {
        apply_entry(entry.first, entry.second, prefix, depth);
      } catch (const std::invalid_argument& error) {
        throw InputError(place(path_, entry.first.Mark()), error.what(), kCure);
      }
    }
  }

 private:
  static constexpr std::size_t kDeepest = 8;   // the parameters have three levels
  static constexpr std::size_t kMost = 10000;  // entries; the parameters are a hundred

  void apply_entry(const YAML::Node& name, const YAML::Node& value, const std::string& prefix,
                   std::size_t depth) {
    const std::string key = prefix + (name.IsScalar() ? name.Scalar() : "");
    if (++entries_ > kMost || depth > kDeepest) {
      throw std::invalid_argument("key '" + key + "' is nested too deep or one of too many");
    }
    if (value.IsMap()) {
      apply(value, key + ".", depth + 1);
    } else if (value.IsScalar()) {
      table_.set(key, value.Scalar());
    } else {
      throw std::invalid_argument("key '" + key + "' must have a single value");
    }
  }

  const std::string& path_;
  ParameterTable& table_;
  std::size_t entries_ = 0;
};

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
  if (const std::string fault = fault_of_file(path); !fault.empty()) {
    throw InputError(path, fault == "no such file" ? "no such parameter file" : fault,
                     "check the path after --params");
  }
  YAML::Node document;
  try {
    document = YAML::LoadFile(path);
  } catch (const YAML::Exception& error) {
    throw InputError(place(path, error.mark), "is not valid YAML (" + error.msg + ")", kCure);
  }
  if (document.IsNull()) return;
  if (!document.IsMap()) throw InputError(path, "is not a map of keys and values", kCure);
  FileWalk(path, table).apply(document, "", 1);
}

}  // namespace oneac
