#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace oneac::simulation {

/// Mixes the bits of x (finaliser of splitmix64): neighbouring inputs give unrelated outputs.
[[nodiscard]] inline std::uint64_t mix_bits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}

/// About standard normal from 64 random bits: the sum of four 16-bit uniforms, |result| ≤ 3.5.
[[nodiscard]] inline double normal_from_bits(std::uint64_t bits) {
  const auto quarter = [bits](unsigned i) {
    return static_cast<double>(bits >> (16U * i) & 0xffffU);
  };
  const double sum = quarter(0) + quarter(1) + quarter(2) + quarter(3);
  constexpr double kUnitVariance = 1.7320508075688772;  // the sum of four uniforms has variance 1/3
  return (sum / 65536.0 - 2.0) * kUnitVariance;
}

/// Seeded numbers. Only the engine of the standard library is used: its distributions differ
/// between implementations.
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : engine_(mix_bits(seed)) {}

  [[nodiscard]] double uniform(double low, double high) {
    constexpr double kResolution = 1.0 / 9007199254740992.0;  // 2^-53
    return low + (high - low) * (static_cast<double>(engine_() >> 11U) * kResolution);
  }
  [[nodiscard]] int integer(int low, int high) {  ///< both bounds included
    return low + static_cast<int>(uniform(0.0, 1.0) * (high - low + 1));
  }
  [[nodiscard]] bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  [[nodiscard]] double normal() { return normal_from_bits(engine_()); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace oneac::simulation
