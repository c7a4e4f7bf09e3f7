#pragma once

#include "oneac/base/bound.h"
#include "oneac/base/require.h"

#include <string>
#include <string_view>
#include <type_traits>

namespace oneac {
namespace internal {

/// Handed to describe(): checks the fields, leaves sections to a validate() of their own.
struct BoundCheck {
  std::string_view prefix;

  template <class Field>
  void operator()(const char* key, const Field& field, const char*, const char*,
                  const Bound& bound = {}) const {
    bool met = false;
    if constexpr (std::is_arithmetic_v<Field>) {
      met = bound.holds(static_cast<double>(field));
    } else {
      met = bound.holds(std::string_view(field));
    }
    if (met) return;
    const std::string name = prefix.empty() ? key : std::string(prefix) + "." + key;
    require(false, name, field, bound.text());
  }
  template <class Options>
  void section(const char*, const Options&) const {}
};

}  // namespace internal

/// Checks every field of an option struct, but not its sections,
/// against the bound that its describe() gives.
/// @param name  of the struct in messages, "klt"; may be empty
/// @throws std::invalid_argument  "name.field = value, must be bound"
template <class Options>
void check_bounds(std::string_view name, const Options& options) {
  // describe() takes what a visitor may change; this one only reads.
  describe(internal::BoundCheck{name}, const_cast<Options&>(options));
}

}  // namespace oneac
