#include "oneac/base/error.h"

#include <algorithm>

namespace oneac {
namespace {

std::string one_line(const std::string& where, const std::string& fault, const std::string& cure) {
  std::string line = where + ": " + fault;
  if (!cure.empty()) line += "; " + cure;
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return line;
}

}  // namespace

InputError::InputError(const std::string& where, const std::string& fault, const std::string& cure)
    : std::runtime_error(one_line(where, fault, cure)) {}

OutputError::OutputError(const std::string& where, const std::string& fault,
                         const std::string& cure)
    : std::runtime_error(one_line(where, fault, cure)) {}

}  // namespace oneac
