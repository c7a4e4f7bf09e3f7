#pragma once

#include <locale>
#include <sstream>
#include <stdexcept>
#include <string_view>

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
  message << field << " = " << value << ", must be " << bound;
  throw std::invalid_argument(message.str());
}

}  // namespace oneac
