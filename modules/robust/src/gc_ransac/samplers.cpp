#include "oneac/robust/samplers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace oneac {
namespace {

constexpr double kProsacDraws = 200000.0;  // T_N of the paper

/// `count` distinct indices below `bound`; for samples of up to eight a look back is cheapest.
void draw_distinct(RandomIndex& random, std::size_t bound, std::size_t count, std::size_t* sample) {
  for (std::size_t i = 0; i < count; ++i) {
    do {
      sample[i] = random.below(bound);
    } while (std::find(sample, sample + i, sample[i]) != sample + i);
  }
}

double binomial(std::size_t n, std::size_t k) {
  double value = 1.0;
  for (std::size_t i = 0; i < k; ++i) {
    value *= static_cast<double>(n - i) / static_cast<double>(i + 1);
  }
  return value;
}

std::size_t distinct_samples(std::size_t n, std::size_t k) {
  // Only samples of one never repeat in these samplers.
  return k == 1 ? n : std::numeric_limits<std::size_t>::max();
}

}  // namespace

UniformSampler::UniformSampler(std::size_t size, std::size_t sample_size, std::uint64_t seed)
    : sample_size_(sample_size), deck_(size), random_(seed) {
  std::iota(deck_.begin(), deck_.end(), std::size_t{0});
}

void UniformSampler::draw(std::size_t* sample) {
  if (sample_size_ > 1) return draw_distinct(random_, deck_.size(), sample_size_, sample);
  const std::size_t i = drawn_++ % deck_.size();
  std::swap(deck_[i], deck_[i + random_.below(deck_.size() - i)]);
  sample[0] = deck_[i];
}

std::size_t UniformSampler::distinct() const {
  return distinct_samples(deck_.size(), sample_size_);
}

ProsacSampler::ProsacSampler(std::size_t size, std::size_t sample_size, std::uint64_t seed)
    : size_(size), sample_size_(sample_size), subset_(sample_size), next_growth_(1), random_(seed) {
  const double samples = binomial(size, sample_size);
  expected_ = std::min(kProsacDraws, samples) / samples;  // T_m, as C(m, m) = 1
}

void ProsacSampler::grow() {
  const auto n = static_cast<double>(subset_);
  const double next = expected_ * (n + 1.0) / (n + 1.0 - static_cast<double>(sample_size_));
  next_growth_ += static_cast<std::size_t>(std::ceil(next - expected_));
  expected_ = next;
  ++subset_;
}

void ProsacSampler::draw(std::size_t* sample) {
  ++drawn_;
  if (drawn_ > next_growth_ && subset_ < size_) grow();
  if (drawn_ > next_growth_) return draw_distinct(random_, subset_, sample_size_, sample);
  draw_distinct(random_, subset_ - 1, sample_size_ - 1, sample);
  sample[sample_size_ - 1] = subset_ - 1;  // the newcomer takes part
}

std::size_t ProsacSampler::distinct() const {
  return distinct_samples(size_, sample_size_);
}

}  // namespace oneac
