#include "oneac/base/printable.h"

#include <gtest/gtest.h>

namespace oneac {
namespace {

TEST(Printable, KeepsUtf8OfEveryLength) {
  const std::string text = "a \xc3\xa4 \xe2\x80\xa6 \xf0\x9f\x9a\x97";
  EXPECT_EQ(printable(text), text);
}

TEST(Printable, ReplacesWhatIsNoUtf8) {
  EXPECT_EQ(printable("stra\xdf"
                      "e"),
            "stra\xef\xbf\xbd"
            "e");                                                                // Latin-1
  EXPECT_EQ(printable("\xc3"), "\xef\xbf\xbd");                                  // cut
  EXPECT_EQ(printable("\xc0\xaf"), "\xef\xbf\xbd\xef\xbf\xbd");                  // overlong
  EXPECT_EQ(printable("\xed\xa0\x80"), "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd");  // surrogate
}

TEST(Printable, LetsNothingSteerATerminal) {
  EXPECT_EQ(printable("a\x1b[2Jb\x7f\n\tc"), "a\\x1b[2Jb\\x7f  c");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\x9b31m");  // the control sequence of eight bits
}

TEST(Printable, KnowsUtf8) {
  EXPECT_TRUE(is_utf8("a \xc3\xa4"));
  EXPECT_FALSE(is_utf8("a \xe4"));
}

TEST(Shortened, KeepsBeginAndEndWithinTheBound) {
  const std::string text = shortened(std::string(100000, 'a') + "end", 100);
  EXPECT_LE(text.size(), 100U);
  EXPECT_EQ(text.substr(0, 10), "aaaaaaaaaa");
  EXPECT_EQ(text.substr(text.size() - 4), "aend");
  EXPECT_NE(text.find("\xe2\x80\xa6"), std::string::npos);
  EXPECT_EQ(shortened("short", 100), "short");
}

TEST(Shortened, CutsNoCharacter) {
  std::string umlauts;
  for (int i = 0; i < 100; ++i) umlauts += "\xc3\xa4";
  for (std::size_t most = 16; most < 40; ++most) {
    const std::string text = shortened(umlauts, most);
    EXPECT_EQ(printable(text), text) << most;
  }
}

}  // namespace
}  // namespace oneac
