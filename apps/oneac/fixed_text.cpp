#include "fixed_text.h"

#include <charconv>

namespace oneac::app {

std::string fixed_text(double value, int decimals) {
  char text[64];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, decimals).ptr;
  return {text, end};
}

}  // namespace oneac::app
