#include "oneac/base/printable.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace oneac {
namespace {

constexpr const char* kReplacement = "\xef\xbf\xbd";  // U+FFFD
constexpr std::string_view kEllipsis = "\xe2\x80\xa6";
constexpr std::uint32_t kNone = 0xffffffff;

std::uint32_t byte_at(std::string_view text, std::size_t at) {
  return static_cast<std::uint8_t>(text[at]);
}

bool continues(std::string_view text, std::size_t at) {
  return at < text.size() && (byte_at(text, at) & 0xc0U) == 0x80U;
}

/// Bytes of the character whose first byte this is; 0 for none.
std::size_t length_of(std::uint32_t first) {
  if (first < 0x80) return 1;
  if (first < 0xc2) return 0;
  if (first < 0xe0) return 2;
  if (first < 0xf0) return 3;
  return first < 0xf5 ? 4 : 0;
}

struct Character {
  std::uint32_t code = kNone;  ///< kNone: no UTF-8
  std::size_t bytes = 1;
};

Character character_at(std::string_view text, std::size_t at) {
  static constexpr std::array<std::uint32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
  const std::uint32_t first = byte_at(text, at);
  const std::size_t bytes = length_of(first);
  if (bytes <= 1) return {bytes == 1 ? first : kNone, 1};
  std::uint32_t code = first & (0x7fU >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if (!continues(text, at + i)) return {};
    code = code << 6U | (byte_at(text, at + i) & 0x3fU);
  }
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  const bool good = code >= kLeast[bytes] && code <= 0x10ffff && !surrogate;
  return good ? Character{code, bytes} : Character{};
}

bool is_control(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0);
}

std::string escape_of(std::uint32_t code) {
  static constexpr std::string_view kDigits = "0123456789abcdef";
  return {'\\', 'x', kDigits[code >> 4U & 15U], kDigits[code & 15U]};
}

}  // namespace

std::string printable(std::string_view text) {
  std::string line;
  for (std::size_t at = 0; at < text.size();) {
    const Character c = character_at(text, at);
    if (c.code == kNone) {
      line += kReplacement;
    } else if (c.code == '\n' || c.code == '\r' || c.code == '\t') {
      line += ' ';
    } else if (is_control(c.code)) {
      line += escape_of(c.code);
    } else {
      line += text.substr(at, c.bytes);
    }
    at += c.bytes;
  }
  return line;
}

bool is_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const Character c = character_at(text, at);
    if (c.code == kNone) return false;
    at += c.bytes;
  }
  return true;
}

std::string shortened(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  const std::size_t room = most - kEllipsis.size();
  std::size_t head = room * 3 / 4;
  std::size_t tail = text.size() - (room - head);
  while (head > 0 && continues(text, head)) --head;
  while (continues(text, tail)) ++tail;
  return std::string(text.substr(0, head)).append(kEllipsis).append(text.substr(tail));
}

}  // namespace oneac
