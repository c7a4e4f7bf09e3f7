#include "oneac/study/trial_random.h"

#include <cmath>

namespace oneac {
namespace {

constexpr double kTwoPi = 6.283185307179586;

/// Finaliser of SplitMix64 (Steele, Lea, Flood 2014): neighbouring inputs give unrelated outputs.
[[nodiscard]] std::uint64_t mixed(std::uint64_t value) {
  value += 0x9E3779B97F4A7C15ULL;
  value = (value ^ (value >> 30)) * 0xBF58476D1CE4E5B9ULL;
  value = (value ^ (value >> 27)) * 0x94D049BB133111EBULL;
  return value ^ (value >> 31);
}

}  // namespace

std::uint64_t trial_seed(std::uint64_t study_seed, std::string_view experiment, std::size_t point,
                         std::size_t trial) {
  std::uint64_t seed = mixed(study_seed);
  for (const char letter : experiment) seed = mixed(seed ^ static_cast<unsigned char>(letter));
  seed = mixed(seed ^ point);
  return mixed(seed ^ trial);
}

double TrialRandom::uniform(double low, double high) {
  const double unit = static_cast<double>(engine_() >> 11) * 0x1.0p-53;
  return low + (high - low) * unit;
}

double TrialRandom::normal(double sigma) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(0.0, 1.0)));
  return sigma * radius * std::cos(uniform(0.0, kTwoPi));
}

double TrialRandom::sign() {
  return (engine_() >> 63) != 0U ? 1.0 : -1.0;
}

}  // namespace oneac
