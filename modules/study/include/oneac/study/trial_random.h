#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string_view>

namespace oneac {

/// Seed of one trial: a function of its place in the study only, so that neither the number of
/// threads nor the other figures of a run change what it draws.
[[nodiscard]] std::uint64_t trial_seed(std::uint64_t study_seed, std::string_view experiment,
                                       std::size_t point, std::size_t trial);

/// Random numbers of one trial. The standard distributions differ between libraries, so only the
/// engine is used and mapped here.
class TrialRandom {
 public:
  explicit TrialRandom(std::uint64_t seed) : engine_(seed) {}

  /// In [low, high).
  [[nodiscard]] double uniform(double low, double high);
  /// Zero mean.
  [[nodiscard]] double normal(double sigma);
  /// −1 or +1.
  [[nodiscard]] double sign();

 private:
  std::mt19937_64 engine_;
};

}  // namespace oneac
