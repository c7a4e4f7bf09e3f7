#pragma once

#include "oneac/base/bound.h"

#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace oneac {

/// A flat view of option structs: "section.key" names bound to their fields,
/// with unit, meaning and bound.
///
/// An option struct takes part by a free function `describe(visit, options)` beside it, which calls
/// `visit(key, field, unit, meaning, bound)` for each field (no bound: any value) and
/// `visit.section(name, nested)` for each nested struct. The table is what YAML files, `--set` and
/// the shipped defaults are made from, so that they cannot differ. It borrows the structs: they
/// must outlive it.
class ParameterTable {
 public:
  using Target = std::variant<double*, int*, std::size_t*, bool*, std::string*>;
  struct Parameter {
    std::string key;
    Target target;
    std::string unit;
    std::string meaning;
    Bound bound;
  };

  /// Adds every field of `options` under "prefix." (or bare when the prefix is empty).
  template <class Options>
  void add(const std::string& prefix, Options& options) {
    describe(Visitor{*this, prefix.empty() ? "" : prefix + "."}, options);
  }

  /// Sets one value from text, as it stands in a YAML file or after `--set key=`.
  /// @throws std::invalid_argument when the key is unknown (the nearest one is suggested) or the
  ///         text is not of the field's type
  void set(const std::string& key, const std::string& text);

  /// @throws std::invalid_argument  "key = value, must be bound", the key in full
  void check_bounds() const;

  /// The key in full of a field that a message names by its struct, "window.fixed": the first that
  /// ends so; the name itself where none does.
  [[nodiscard]] std::string full_key(const std::string& name) const;

  /// In the order they were added.
  [[nodiscard]] const std::vector<Parameter>& parameters() const { return parameters_; }
  [[nodiscard]] std::string value_text(const Parameter& parameter) const;
  /// All values as a YAML document, "# [unit, bound] meaning" behind each when `comments`.
  [[nodiscard]] std::string to_yaml(bool comments) const;

 private:
  /// Handed to describe(): prefixes the keys and recurses into sections.
  struct Visitor {
    ParameterTable& table;
    std::string prefix;

    template <class Field>
    void operator()(const char* key, Field& field, const char* unit, const char* meaning,
                    const Bound& bound = {}) const {
      table.parameters_.push_back({prefix + key, Target(&field), unit, meaning, bound});
    }
    template <class Options>
    void section(const char* name, Options& options) const {
      describe(Visitor{table, prefix + name + "."}, options);
    }
  };

  std::vector<Parameter> parameters_;
};

}  // namespace oneac
