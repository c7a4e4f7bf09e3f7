#include "oneac/report/table.h"

#include "oneac/report/html_page.h"

namespace oneac {
namespace {

std::string td(const Cell& cell) {
  const char* const open = cell.mark == Cell::Mark::kNone   ? "<td>"
                           : cell.mark == Cell::Mark::kBest ? "<td class=\"best\">"
                                                            : "<td class=\"bad\">";
  return open + html_escaped(cell.text) + "</td>";
}

std::string quoted(const std::string& cell) {
  std::string text = "\"";
  for (const char letter : cell) text += letter == '"' ? "\"\"" : std::string(1, letter);
  return text + '"';
}

}  // namespace

std::string table_html(const Table& table) {
  std::string html = "<table>";
  if (!table.caption.empty()) html += "<caption>" + html_escaped(table.caption) + "</caption>";
  if (!table.head.empty()) {
    html += "<tr>";
    for (const std::string& name : table.head) html += "<th>" + html_escaped(name) + "</th>";
    html += "</tr>";
  }
  for (const std::vector<Cell>& row : table.rows) {
    html += "\n<tr>";
    for (const Cell& cell : row) html += td(cell);
    html += "</tr>";
  }
  return html + "\n</table>\n";
}

std::string table_md(const Table& table) {
  std::string text = "|", rule = "|";
  for (std::size_t i = 0; i < table.head.size(); ++i) {
    text += table.head[i].empty() ? " |" : " " + table.head[i] + " |";
    rule += i < table.text_columns ? "---|" : "--:|";
  }
  text += "\n" + rule + "\n";
  for (const std::vector<Cell>& row : table.rows) {
    text += "|";
    for (const Cell& cell : row) {
      const char* const star = cell.mark == Cell::Mark::kNone || cell.text.empty() ? "" : "**";
      text += " " + std::string(star) + cell.text + star + " |";
    }
    text += "\n";
  }
  return text;
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) {
    if (&cell != &cells.front()) line += ',';
    line += cell.find_first_of(",\"\r\n") == std::string::npos ? cell : quoted(cell);
  }
  return line + '\n';
}

}  // namespace oneac
