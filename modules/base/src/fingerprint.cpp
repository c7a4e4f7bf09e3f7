#include "oneac/base/fingerprint.h"

#include <algorithm>
#include <cstring>
#include <string_view>

namespace oneac {
namespace {

std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) {
  constexpr std::uint64_t kPrime = 0x100000001b3;
  hash = (hash ^ word) * kPrime;
  return hash ^ hash >> 32U;
}

template <class Byte>
std::uint64_t mixed(std::uint64_t hash, const Byte* bytes, std::size_t count) {
  for (std::size_t at = 0; at < count; at += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + at, std::min(sizeof word, count - at));
    hash = mixed(hash, word);
  }
  return hash;
}

}  // namespace

void Fingerprint::add(std::uint64_t word) {
  hash_ = mixed(hash_, word);
}

void Fingerprint::add(double number) {
  std::uint64_t word = 0;
  static_assert(sizeof word == sizeof number);
  std::memcpy(&word, &number, sizeof word);
  add(word);
}

void Fingerprint::add(const char* bytes, std::size_t count) {
  hash_ = mixed(hash_, bytes, count);
  add(std::uint64_t{count});
}

void Fingerprint::add(const ImageView& image) {
  const auto width = static_cast<std::size_t>(image.width);
  add(std::uint64_t{width});
  add(static_cast<std::uint64_t>(image.height));
  for (int v = 0; v < image.height; ++v) {
    hash_ = mixed(hash_, image.data + static_cast<std::ptrdiff_t>(v) * image.stride, width);
  }
}

std::string Fingerprint::text() const {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4) text += kDigits[hash_ >> shift & 15U];
  return text;
}

}  // namespace oneac
