#include "oneac/report/html_page.h"

#include <gtest/gtest.h>

#include <string>

namespace oneac {
namespace {

TEST(HtmlPage, EscapesTextsButNotFigures) {
  HtmlPage page("a < b", "\"c\" & d");
  page.table("<caption>", {{"<name>", "<value>"}});
  page.figures({"<svg id=\"one\"></svg>"});
  const std::string html = page.text();
  EXPECT_NE(html.find("<title>a &lt; b</title>"), std::string::npos);
  EXPECT_NE(html.find("&quot;c&quot; &amp; d"), std::string::npos);
  EXPECT_NE(html.find("<td>&lt;name&gt;</td><td>&lt;value&gt;</td>"), std::string::npos);
  EXPECT_NE(html.find("<svg id=\"one\"></svg>"), std::string::npos);
}

TEST(HtmlPage, ForbidsTheBrowserToLoadAnything) {
  const std::string html = HtmlPage("t", "s").text();
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(html.find("http:"), std::string::npos);
  EXPECT_EQ(html.find("https:"), std::string::npos);
  EXPECT_EQ(html.find("<script"), std::string::npos);
}

TEST(HtmlPage, HasAStyleForTheDark) {
  EXPECT_NE(HtmlPage("t", "s").text().find("prefers-color-scheme:dark"), std::string::npos);
}

TEST(Base64Of, AgreesWithTheExamplesOfTheStandard) {  // RFC 4648, section 10
  EXPECT_EQ(base64_of(""), "");
  EXPECT_EQ(base64_of("f"), "Zg==");
  EXPECT_EQ(base64_of("fo"), "Zm8=");
  EXPECT_EQ(base64_of("foo"), "Zm9v");
  EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64_of("\xff\xfe"), "//4=");
}

TEST(HtmlPage, LegendHidesCurvesWithoutAScript) {
  HtmlPage page("t", "s");
  page.legend({"a", "<b>"});
  const std::string html = page.text();
  EXPECT_NE(html.find("id=\"show1\""), std::string::npos);
  EXPECT_NE(html.find("body:has(#show1:not(:checked)) .plot .m1{display:none}"), std::string::npos);
  EXPECT_NE(html.find("&lt;b&gt;"), std::string::npos);
  EXPECT_EQ(html.find("<script"), std::string::npos);
}

}  // namespace
}  // namespace oneac
