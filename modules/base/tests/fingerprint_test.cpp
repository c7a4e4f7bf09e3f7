#include "oneac/base/fingerprint.h"

#include <gtest/gtest.h>

#include <string>

namespace oneac {
namespace {

std::uint64_t of_bytes(const std::string& bytes) {
  Fingerprint print;
  print.add(bytes.data(), bytes.size());
  return print.value();
}

TEST(Fingerprint, TellsContentsLengthsAndOrdersApart) {
  EXPECT_EQ(of_bytes("a road"), of_bytes("a road"));
  EXPECT_NE(of_bytes("a road"), of_bytes("a ro"));
  EXPECT_NE(of_bytes("ab"), of_bytes(std::string("ab\0", 3)));
  EXPECT_NE(of_bytes("12345678abcdefgh"), of_bytes("abcdefgh12345678"));
  Fingerprint one, other;
  one.add(0.1);
  other.add(0.2);
  EXPECT_NE(one.value(), other.value());
}

TEST(Fingerprint, SeesAnImagesPixelsAndNotTheBytesBetweenItsRows) {
  GreyImage wide(12, 3, 7), narrow(10, 3, 7);
  wide.row(1)[11] = 200;  // beyond a view of ten columns
  const ImageView cut{wide.view().data, 10, 3, 12};
  Fingerprint a, b, c;
  a.add(cut);
  b.add(narrow.view());
  EXPECT_EQ(a.value(), b.value());
  narrow.row(2)[9] = 8;
  c.add(narrow.view());
  EXPECT_NE(c.value(), b.value());
}

TEST(Fingerprint, ReadsAsSixteenDigits) {
  EXPECT_EQ(Fingerprint().text(), "cbf29ce484222325");
}

}  // namespace
}  // namespace oneac
