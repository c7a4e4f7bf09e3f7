#include "oneac/observations/repeat_watch.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>

namespace oneac {
namespace {

constexpr std::uint64_t kStart = 14695981039346656037ULL, kPrime = 1099511628211ULL;  // of FNV-1a

std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) {
  hash = (hash ^ word) * kPrime;
  return hash ^ (hash >> 32U);
}

/// FNV-1a over words of eight pixels.
std::uint64_t hash_of(const ImageView& image) {
  const auto width = static_cast<std::size_t>(image.width);
  std::uint64_t hash = mixed(mixed(kStart, width), static_cast<std::uint64_t>(image.height));
  for (int v = 0; v < image.height; ++v) {
    const std::uint8_t* row = image.data + static_cast<std::ptrdiff_t>(v) * image.stride;
    for (std::size_t u = 0; u < width; u += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, row + u, std::min(sizeof word, width - u));
      hash = mixed(hash, word);
    }
  }
  return hash;
}

}  // namespace

bool RepeatWatch::repeats(const ImageView& image) {
  const std::uint64_t now = hash_of(image);
  return std::exchange(before_, now) == now;
}

}  // namespace oneac
