#include "oneac/test_support/mutation.h"

#include <algorithm>
#include <array>
#include <random>

namespace oneac {
namespace {

// std::uniform_int_distribution differs between libraries; this does not.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  /// 0 … sides − 1.
  std::size_t roll(std::size_t sides) { return sides == 0 ? 0 : engine_() % sides; }

 private:
  std::mt19937_64 engine_;
};

constexpr std::size_t kLongestPiece = 400;  // about a record of a stereo log

void flip_bits(std::string& bytes, Dice& dice) {
  for (std::size_t n = 1 + dice.roll(8); n > 0; --n) {
    char& byte = bytes[dice.roll(bytes.size())];
    byte = static_cast<char>(byte ^ static_cast<char>(1U << dice.roll(8)));
  }
}

void replace_word(std::string& bytes, Dice& dice) {
  constexpr std::array<std::uint32_t, 8> kWords{0U,          1U,          0x7fU,       0xffffU,
                                                0x01000000U, 0x10000000U, 0x7fffffffU, 0xffffffffU};
  const std::uint32_t word = kWords[dice.roll(kWords.size())];
  const std::size_t at = dice.roll(bytes.size());
  for (std::size_t i = 0; i < 4 && at + i < bytes.size(); ++i) {
    bytes[at + i] = static_cast<char>(word >> (8 * i) & 0xffU);
  }
}

void injure(std::string& bytes, Dice& dice) {
  if (bytes.empty()) return;
  const std::size_t at = dice.roll(bytes.size());
  const std::size_t length = std::min(1 + dice.roll(kLongestPiece), bytes.size() - at);
  switch (dice.roll(8)) {
    case 0:
      bytes.resize(at);
      break;
    case 1:
      bytes.erase(at, length);
      break;
    case 2:
      bytes.insert(at, bytes.substr(at, length));
      break;
    case 3:
      std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), length, '\0');
      break;
    case 4:
      for (std::size_t i = 0; i < length; ++i) bytes[at + i] = static_cast<char>(dice.roll(256));
      break;
    case 5:
      replace_word(bytes, dice);
      break;
    default:
      flip_bits(bytes, dice);
      break;
  }
}

}  // namespace

std::string mutated(std::string bytes, std::uint64_t seed) {
  Dice dice(seed);
  for (std::size_t n = 1 + dice.roll(3); n > 0; --n) injure(bytes, dice);
  return bytes;
}

}  // namespace oneac
