#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace oneac {

/// Random indices that are the same with every standard library: the engine is fixed by the
/// standard, the mapping to integers is ours.
class RandomIndex {
 public:
  /// Same seed, same numbers, on every machine.
  explicit RandomIndex(std::uint64_t seed) : engine_(seed) {}
  /// Uniform in 0 … bound − 1. @pre 0 < bound < 2³²
  [[nodiscard]] std::size_t below(std::size_t bound) {
    return static_cast<std::size_t>(((engine_() >> 32U) * bound) >> 32U);
  }

 private:
  std::mt19937_64 engine_;
};

/// Draws minimal samples, `sample_size` distinct indices each.
class Sampler {
 public:
  virtual ~Sampler() = default;
  /// Writes sample_size indices. No allocation.
  virtual void draw(std::size_t* sample) = 0;
  /// Samples that differ; drawing more brings nothing new. Huge for all but single correspondences.
  [[nodiscard]] virtual std::size_t distinct() const = 0;

 protected:
  Sampler() = default;
  Sampler(const Sampler&) = default;
  Sampler& operator=(const Sampler&) = default;
};

/// Every sample equally likely. Samples of one correspondence are drawn without replacement: each
/// of the n comes up once in n draws.
class UniformSampler : public Sampler {
 public:
  /// @pre 1 ≤ sample_size ≤ size
  UniformSampler(std::size_t size, std::size_t sample_size, std::uint64_t seed);
  void draw(std::size_t* sample) override;
  [[nodiscard]] std::size_t distinct() const override;

 private:
  std::size_t sample_size_;
  std::size_t drawn_ = 0;
  std::vector<std::size_t> deck_;
  RandomIndex random_;
};

/// Chum and Matas, "Matching with PROSAC", 2005: samples from a growing set of the best
/// correspondences, index 0 the best one; in the end as the uniform sampler.
///
/// The growth is spread over min(200000, C(n, m)) draws: the paper's 200000 for m ≥ 2, and a single
/// correspondence is drawn just once.
class ProsacSampler : public Sampler {
 public:
  /// @pre 1 ≤ sample_size ≤ size
  ProsacSampler(std::size_t size, std::size_t sample_size, std::uint64_t seed);
  void draw(std::size_t* sample) override;
  [[nodiscard]] std::size_t distinct() const override;
  /// Correspondences that the last draw chose from.
  [[nodiscard]] std::size_t subset() const { return subset_; }

 private:
  void grow();

  std::size_t size_;
  std::size_t sample_size_;
  std::size_t subset_;       ///< n of the paper
  std::size_t drawn_ = 0;    ///< t
  std::size_t next_growth_;  ///< T'_n
  double expected_;          ///< T_n
  RandomIndex random_;
};

}  // namespace oneac
