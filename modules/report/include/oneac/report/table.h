#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace oneac {

struct Cell {
  enum class Mark { kNone, kBest, kBad };

  std::string text;
  Mark mark = Mark::kNone;
};

/// Rows of cells under a head, which may be empty.
struct Table {
  std::string caption;
  std::vector<std::string> head;
  std::vector<std::vector<Cell>> rows;
  std::size_t text_columns = 1;  ///< aligned left; numbers follow, aligned right
};

/// A <table> element; texts are escaped, marks are classes.
[[nodiscard]] std::string table_html(const Table& table);
/// A table of Markdown without its caption; what is marked is bold.
[[nodiscard]] std::string table_md(const Table& table);
/// A line of a CSV file with its end; a cell with a comma, a quote or a line break is
/// quoted as in RFC 4180.
[[nodiscard]] std::string csv_line(const std::vector<std::string>& cells);

}  // namespace oneac
