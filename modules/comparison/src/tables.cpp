#include "oneac/comparison/tables.h"

#include "oneac/base/number_text.h"
#include "oneac/report/table.h"

#include <charconv>
#include <cmath>
#include <functional>

namespace oneac {
namespace {

using Number = std::optional<double>;

constexpr const char* kEmpty = "–";

/// A quantity of the table and how to read it from a summary.
struct Quantity {
  const char* title;
  bool more_is_better;
  int digits;
  std::function<Number(const MethodSummary&)> get;
};

std::vector<Quantity> quantities() {
  const auto auc = [](std::size_t i) {
    return [i](const MethodSummary& s) -> Number {
      return s.auc[i] ? Number(100.0 * *s.auc[i]) : Number();
    };
  };
  return {
      {"Time (ms)", false, 3, [](const MethodSummary& s) { return s.ms_mean; }},
      {"Rotation (°)", false, 4, [](const MethodSummary& s) { return s.rotation_mean_deg; }},
      {"Translation (°)", false, 3, [](const MethodSummary& s) { return s.direction_mean_deg; }},
      {"AUC@1° (%)", true, 1, auc(0)},
      {"AUC@5° (%)", true, 1, auc(1)},
      {"AUC@10° (%)", true, 1, auc(2)},
      {"Failures", false, 0,
       [](const MethodSummary& s) { return Number(static_cast<double>(s.failures)); }},
      {"Iterations", false, 0, [](const MethodSummary& s) { return s.iterations_mean; }},
  };
}

double number_in(const std::string& text) {
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

void mark_best(TableBlock& block) {
  for (std::size_t log = 0; log < block.logs.size(); ++log) {
    Number best;
    for (const auto& row : block.cells) {
      if (row[log] == kEmpty) continue;
      const double value = number_in(row[log]);
      if (!best || (block.more_is_better ? value > *best : value < *best)) best = value;
    }
    // As printed: equal digits are equally good.
    for (std::size_t m = 0; m < block.methods.size(); ++m) {
      const std::string& text = block.cells[m][log];
      block.best[m][log] = best && text != kEmpty && !(std::abs(number_in(text) - *best) > 0.0);
    }
  }
}

TableBlock block_of(const std::vector<MethodSummary>& rows, const Quantity& quantity) {
  TableBlock block;
  block.title = quantity.title;
  block.more_is_better = quantity.more_is_better;
  for (const MethodSummary& row : rows) {
    if (row.log == rows.front().log) block.methods.push_back(row.method);
    if (block.logs.empty() || block.logs.back() != row.log) block.logs.push_back(row.log);
  }
  const std::size_t methods = block.methods.size();
  block.cells.assign(methods, std::vector<std::string>(block.logs.size(), kEmpty));
  block.best.assign(methods, std::vector<bool>(block.logs.size(), false));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Number value = quantity.get(rows[i]);
    if (value) block.cells[i % methods][i / methods] = fixed_text(*value, quantity.digits);
  }
  mark_best(block);
  return block;
}

std::string tex_escaped(const std::string& text) {
  std::string safe;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char letter = text[i];
    if (letter == '_' || letter == '%' || letter == '#' || letter == '&') safe += '\\';
    if (text.compare(i, 2, "°") == 0) {
      safe += "$^\\circ$";
      i += 1;
    } else if (text.compare(i, 3, "–") == 0) {
      safe += "--";
      i += 2;
    } else {
      safe += letter;
    }
  }
  return safe;
}

}  // namespace

std::vector<TableBlock> table_blocks(const std::vector<MethodSummary>& rows) {
  std::vector<TableBlock> blocks;
  if (rows.empty()) return blocks;
  for (const Quantity& quantity : quantities()) blocks.push_back(block_of(rows, quantity));
  return blocks;
}

Cell cell_of(const TableBlock& block, std::size_t method, std::size_t log) {
  return {block.cells[method][log],
          block.best[method][log] ? Cell::Mark::kBest : Cell::Mark::kNone};
}

std::string table_md(const std::vector<TableBlock>& blocks) {
  if (blocks.empty()) return "";
  Table table{"", {"", "method"}, {}, 2};
  const std::vector<std::string>& logs = blocks.front().logs;
  table.head.insert(table.head.end(), logs.begin(), logs.end());
  for (const TableBlock& block : blocks) {
    for (std::size_t m = 0; m < block.methods.size(); ++m) {
      table.rows.push_back({{m == 0 ? block.title : "", Cell::Mark::kBest}, {block.methods[m]}});
      for (std::size_t log = 0; log < block.logs.size(); ++log) {
        table.rows.back().push_back(cell_of(block, m, log));
      }
    }
  }
  return table_md(table);
}

std::string table_tex(const std::vector<TableBlock>& blocks) {
  std::string text = "% needs \\usepackage{multirow,graphicx}\n";
  for (const TableBlock& block : blocks) {
    const std::string rows = std::to_string(block.methods.size());
    if (&block == &blocks.front()) {
      text += "\\begin{tabular}{|l|r|" + std::string(block.logs.size(), 'c') + "|}\n\\hline\n& ";
      for (const std::string& log : block.logs) text += "& " + tex_escaped(log) + " ";
      text += "\\\\\n\\hline\n";
    }
    for (std::size_t m = 0; m < block.methods.size(); ++m) {
      if (m == 0) {
        text += "\\multirow{" + rows + "}{*}{\\rotatebox[origin=c]{90}{" +
                tex_escaped(block.title) + "}} ";
      }
      text += "& " + tex_escaped(block.methods[m]);
      for (std::size_t log = 0; log < block.logs.size(); ++log) {
        const std::string value = tex_escaped(block.cells[m][log]);
        text += block.best[m][log] ? " & \\textbf{" + value + "}" : " & " + value;
      }
      text += " \\\\\n";
    }
    text += "\\hline\n";
  }
  return text + (blocks.empty() ? "" : "\\end{tabular}\n");
}

}  // namespace oneac
