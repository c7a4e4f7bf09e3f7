#include "oneac/comparison/tables.h"

#include "oneac/comparison/html_report.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace oneac {
namespace {

MethodSummary summary(const char* log, const char* method, double rotation, double ms) {
  MethodSummary row;
  row.log = log;
  row.method = method;
  row.rotation_mean_deg = rotation;
  row.ms_mean = ms;
  row.auc[0] = 0.5 - rotation;
  return row;
}

std::vector<MethodSummary> rows() {
  return {summary("one", "a_b", 0.1, 3.0), summary("one", "c", 0.2, 1.0),
          summary("average", "a_b", 0.1, 3.0), summary("average", "c", 0.2, 1.0)};
}

TEST(TableBlocks, MarkTheLeastErrorAndTheLargestArea) {
  const auto blocks = table_blocks(rows());
  ASSERT_GE(blocks.size(), 4U);
  EXPECT_EQ(blocks[0].title, "Time (ms)");
  EXPECT_EQ(blocks[0].logs, (std::vector<std::string>{"one", "average"}));
  EXPECT_FALSE(blocks[0].best[0][0]);
  EXPECT_TRUE(blocks[0].best[1][0]);
  EXPECT_TRUE(blocks[1].best[0][1]);
  EXPECT_TRUE(blocks[3].more_is_better);
  EXPECT_TRUE(blocks[3].best[0][0]);
}

TEST(TableMd, HasABoldBestAndADashWhereEmpty) {
  const std::string text = table_md(table_blocks(rows()));
  EXPECT_NE(text.find("| **Time (ms)** | a_b | 3.000 | 3.000 |"), std::string::npos) << text;
  EXPECT_NE(text.find("**0.1000**"), std::string::npos);
  EXPECT_NE(text.find("| – |"), std::string::npos);
}

TEST(TableTex, EscapesAndCloses) {
  const std::string text = table_tex(table_blocks(rows()));
  EXPECT_NE(text.find("a\\_b"), std::string::npos);
  EXPECT_NE(text.find("$^\\circ$"), std::string::npos);
  EXPECT_NE(text.find("\\textbf{0.1000}"), std::string::npos);
  EXPECT_NE(text.find("\\end{tabular}"), std::string::npos);
  EXPECT_EQ(text.find("–"), std::string::npos);
}

TEST(PairsCsv, LeavesCellsWithoutAPoseEmpty) {
  ComparisonData data;
  data.methods = {"a"};
  PairRecord pair;
  pair.index2 = 1;
  pair.acs = 3;
  MethodResult result;
  result.status = "too_few";
  pair.results = {result};
  data.pairs = {pair};
  const std::string text = pairs_csv(data);
  EXPECT_NE(text.find("0,0,1,a,0,too_few,,,,,,,,,,0,3,0,0,0,0\n"), std::string::npos) << text;
  // As many fields in each line.
  const auto end = text.find('\n');
  EXPECT_EQ(std::count(text.begin(), text.begin() + static_cast<long>(end), ','),
            std::count(text.begin() + static_cast<long>(end), text.end(), ','));
}

TEST(HtmlReport, NeedsNothingFromElsewhereAndEscapesNames) {
  ComparisonData data;
  data.methods = {"<script>"};
  LogRecord log;
  log.name = "a&b";
  data.logs = {log};
  PairRecord pair;
  MethodResult result;
  result.status = "ok";
  pair.results = {result};
  data.pairs = {pair};
  const std::string html =
      html_report(data, summarise(data), {{0, 0, {1, 1, "foo", {}}}}, {"a < b"});
  EXPECT_EQ(html.find("http:"), std::string::npos);
  EXPECT_EQ(html.find("https:"), std::string::npos);
  EXPECT_NE(html.find("&lt;script&gt;"), std::string::npos);
  EXPECT_NE(html.find("a &lt; b"), std::string::npos);
  EXPECT_NE(html.find("data:image/jpeg;base64,Zm9v"), std::string::npos);
  EXPECT_NE(html.find("prefers-color-scheme:dark"), std::string::npos);
}

}  // namespace
}  // namespace oneac
