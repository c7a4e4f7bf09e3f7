#pragma once

#include <cstdint>
#include <string>

namespace oneac {

/// The bytes with a few random injuries: bits flipped, bytes or 32-bit words replaced, pieces
/// removed, doubled, blanked or put in, the end cut off. The same seed gives the same injuries.
[[nodiscard]] std::string mutated(std::string bytes, std::uint64_t seed);

}  // namespace oneac
