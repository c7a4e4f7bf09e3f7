#pragma once

#include "oneac/base/number_text.h"

#include <locale>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <type_traits>

namespace oneac {

/// Checks an option: what validate() of every option struct is made of.
/// @param field  section and name as in the YAML file, "consensus.max_pitch_deg"
/// @param bound  what the value must be, "positive", "1 … 1024"
/// @throws std::invalid_argument  "field = value, must be bound"
template <class Value>
void require(bool met, std::string_view field, const Value& value, std::string_view bound) {
  if (met) return;
  std::ostringstream message;
  message.imbue(std::locale::classic());
  message << field << " = ";
  if constexpr (std::is_floating_point_v<Value>) {
    message << exact_text(value);  // 5.0000001 is not "5"
  } else {
    message << value;
  }
  message << ", must be " << bound;
  throw std::invalid_argument(message.str());
}

}  // namespace oneac
