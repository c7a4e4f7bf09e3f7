#include "oneac/evaluation/html_page.h"

#include "oneac/evaluation/snapshot_svg.h"

#include <gtest/gtest.h>

#include <limits>
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

TEST(SnapshotSvg, DrawsInliersApartAndLeavesOutWhatIsNotFinite) {
  Snapshot snapshot;
  snapshot.width = 100;
  snapshot.height = 50;
  snapshot.jpeg = "foo";
  AffineCorrespondence ac;
  ac.x1 = {10.0, 20.0};
  ac.x2 = {12.0, 21.0};
  ac.A << 2.0, 0.0, 0.0, 1.0;
  snapshot.acs = {ac, ac, ac};
  snapshot.acs[1].x1 = {30.0, 40.0};
  snapshot.acs[2].x2.x() = std::numeric_limits<double>::quiet_NaN();
  snapshot.inlier = {true, false, true};
  const std::string svg = snapshot_svg(snapshot);
  // Eight pixels to each side, stretched twice to the right.
  EXPECT_NE(svg.find("class=\"inlier\" d=\"M10.0 20.0L12.0 21.0M-4.0 13.0L28.0 13.0L28.0 29.0L-4.0 "
                     "29.0Z\""),
            std::string::npos)
      << svg;
  EXPECT_NE(svg.find("class=\"outlier\" d=\"M30.0 40.0L"), std::string::npos) << svg;
  EXPECT_NE(svg.find("data:image/jpeg;base64,Zm9v"), std::string::npos) << svg;
  EXPECT_EQ(svg.find("nan"), std::string::npos) << svg;
}

TEST(SnapshotSvg, RefusesFlagsThatDoNotFit) {
  Snapshot snapshot;
  snapshot.inlier = {true};
  EXPECT_THROW((void)snapshot_svg(snapshot), std::invalid_argument);
}

}  // namespace
}  // namespace oneac
