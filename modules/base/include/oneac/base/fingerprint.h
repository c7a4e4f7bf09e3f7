#pragma once

#include "oneac/base/image.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace oneac {

/// 64 bits that stand for what was added, in that order: for telling contents apart, not against
/// forgery. FNV-1a over words of eight bytes, with the upper bits brought down after each.
class Fingerprint {
 public:
  void add(std::uint64_t word);
  void add(double number);
  /// The last word is filled with zeros; how many there were counts, too.
  void add(const char* bytes, std::size_t count);
  /// Size and pixels.
  void add(const ImageView& image);

  [[nodiscard]] std::uint64_t value() const { return hash_; }
  /// 16 hexadecimal digits.
  [[nodiscard]] std::string text() const;

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

}  // namespace oneac
