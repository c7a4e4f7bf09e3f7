#include "import/number_table.h"

#include "oneac/base/error.h"
#include "oneac/base/finite_number.h"
#include "oneac/base/input_file.h"

#include <fstream>
#include <string>
#include <string_view>

namespace oneac {
namespace {

constexpr const char* kBlanks = " \t\r\n,";

struct Line {
  const std::filesystem::path& file;
  std::size_t number;

  [[noreturn]] void fail(const std::string& fault) const {
    throw InputError(file.string() + ": line " + std::to_string(number), fault,
                     "get the file again from its source, or take it away");
  }
};

double parse(std::string_view word, const Line& line) {
  const auto value = finite_number(word);
  if (!value) line.fail("'" + std::string(word) + "' is not a number");
  return *value;
}

std::vector<double> parse_row(std::string_view text, const Line& line) {
  std::vector<double> row;
  for (;;) {
    const auto begin = text.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return row;
    text.remove_prefix(begin);
    const auto end = std::min(text.find_first_of(kBlanks), text.size());
    row.push_back(parse(text.substr(0, end), line));
    text.remove_prefix(end);
  }
}

bool is_comment(const std::string& text) {
  const auto first = text.find_first_not_of(kBlanks);
  return first == std::string::npos || text[first] == '%' || text[first] == '#';
}

}  // namespace

std::vector<std::vector<double>> read_number_table(const std::filesystem::path& file,
                                                   std::size_t least_columns) {
  std::ifstream stream = open_input(file, "put the file there, or take it away");
  std::vector<std::vector<double>> rows;
  std::string text;
  for (std::size_t number = 1; std::getline(stream, text); ++number) {
    if (is_comment(text)) continue;
    const Line line{file, number};
    rows.push_back(parse_row(text, line));
    if (rows.back().size() < least_columns) {
      line.fail("it has " + std::to_string(rows.back().size()) + " numbers, expected " +
                std::to_string(least_columns));
    }
  }
  return rows;
}

}  // namespace oneac
