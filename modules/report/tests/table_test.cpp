#include "oneac/report/table.h"

#include <gtest/gtest.h>

namespace oneac {
namespace {

Table some_table() {
  return {"caption", {"", "a"}, {{{"x < y"}, {"1", Cell::Mark::kBest}}, {{"z"}, {"2"}}}};
}

TEST(Table, EscapesAndMarksInHtml) {
  const std::string html = table_html(some_table());
  EXPECT_NE(html.find("<caption>caption</caption>"), std::string::npos);
  EXPECT_NE(html.find("<th>a</th>"), std::string::npos);
  EXPECT_NE(html.find("<td>x &lt; y</td><td class=\"best\">1</td>"), std::string::npos) << html;
}

TEST(Table, AlignsNumbersAndMarksInMarkdown) {
  EXPECT_EQ(table_md(some_table()), "| | a |\n|---|--:|\n| x < y | **1** |\n| z | 2 |\n");
}

TEST(CsvLine, QuotesOnlyWhatNeedsIt) {
  EXPECT_EQ(csv_line({"a", "", "1.5"}), "a,,1.5\n");
  EXPECT_EQ(csv_line({"a,b", "say \"c\""}), "\"a,b\",\"say \"\"c\"\"\"\n");
}

}  // namespace
}  // namespace oneac
