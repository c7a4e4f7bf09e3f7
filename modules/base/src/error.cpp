#include "oneac/base/error.h"

#include "oneac/base/printable.h"

namespace oneac {
namespace {

// [byte] what a person reads of a part; a path may have 4096.
constexpr std::size_t kLongestPart = 1000;

std::string one_line(const std::string& where, const std::string& fault, const std::string& cure) {
  const auto part = [](const std::string& text) {
    return shortened(printable(text), kLongestPart);
  };
  std::string line = part(where) + ": " + part(fault);
  if (!cure.empty()) line += "; " + part(cure);
  return line;
}

}  // namespace

InputError::InputError(const std::string& where, const std::string& fault, const std::string& cure)
    : std::runtime_error(one_line(where, fault, cure)) {}

OutputError::OutputError(const std::string& where, const std::string& fault,
                         const std::string& cure)
    : std::runtime_error(one_line(where, fault, cure)) {}

}  // namespace oneac
