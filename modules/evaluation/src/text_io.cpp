#include "text_io.h"

#include "oneac/base/error.h"
#include "oneac/base/finite_number.h"
#include "oneac/base/input_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

namespace oneac {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";
constexpr double kNumberBound = 1e15;  // beyond any time or length, far below overflow

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

}  // namespace

std::string where_in(const std::string& file, std::size_t line) {
  return file + ": line " + std::to_string(line);
}

std::string read_text(const std::filesystem::path& path) {
  if (const std::string fault = fault_of_file(path); !fault.empty()) {
    throw InputError(path.string(), fault,
                     fault == "is a folder" ? "name a file in it" : "check the path");
  }
  std::ifstream stream(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream.is_open() || stream.bad()) {
    throw InputError(path.string(), "cannot be read", "check its permissions");
  }
  if (text.empty()) throw InputError(path.string(), "is empty", "write or copy it again");
  return text;
}

std::vector<TextLine> data_lines(std::string_view text) {
  std::vector<TextLine> lines;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    if (!line.empty() && line.front() != '#') lines.push_back({number, line});
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::vector<std::string_view> split_at_blanks(std::string_view line) {
  std::vector<std::string_view> fields;
  while (!(line = trimmed(line)).empty()) {
    const std::size_t end = std::min(line.find_first_of(kBlanks), line.size());
    fields.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
  return fields;
}

std::vector<std::string_view> split_at_commas(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t end = line.find(',');
    fields.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return fields;
    line.remove_prefix(end + 1);
  }
}

std::optional<double> parse_finite(std::string_view field) {
  const auto value = finite_number(field);
  return value && std::abs(*value) < kNumberBound ? value : std::nullopt;
}

}  // namespace oneac
