// What finding alike places costs over a long drive: words of every keyframe, the inverted index, a
// query by every keyframe.
//
//   oneac_bench_retrieval [KEYFRAMES [PLACES]]     laps of PLACES keyframes, 20000 and 2000 by
//   default
//
// Descriptors are simulated: a place has 700 of its own, drawn about 3000 centres that are as
// unequally common as 1/rank; a lap later each is seen again with a probability of a half, with
// noise, and a new one stands in for the others. No image is read, nothing is verified: retrieval
// alone.
#include "place_index.h"
#include "vocabulary.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <random>
#include <vector>

namespace {

using namespace oneac::internal;

constexpr int kFeatures = 700, kCentres = 3000;
constexpr float kSpread = 0.05F, kNoise = 0.02F;  // of entries of unit vectors

class Street {
 public:
  explicit Street(std::size_t places) : places_(places), centres_(kCentres, 128) {
    std::mt19937 generator(7);
    std::exponential_distribution<float> entry(1.0F);
    for (Eigen::Index i = 0; i < centres_.size(); ++i) centres_.data()[i] = entry(generator);
    centres_.rowwise().normalize();
    std::vector<double> share(kCentres);
    for (std::size_t i = 0; i < share.size(); ++i) share[i] = 1.0 / static_cast<double>(i + 1);
    common_ = std::discrete_distribution<int>(share.begin(), share.end());
  }

  Descriptors8 seen_by(std::size_t keyframe) const {
    const std::size_t place = keyframe % places_;
    FloatDescriptors all = descriptors(place, kSpread);
    const FloatDescriptors others = descriptors(places_ + keyframe, kSpread);
    std::mt19937 generator(static_cast<unsigned>(keyframe) + 1000003U);
    std::normal_distribution<float> noise(0.0F, kNoise);
    std::bernoulli_distribution again(0.5);
    for (Eigen::Index i = 0; i < all.rows(); ++i) {
      if (!again(generator)) all.row(i) = others.row(i);
      for (Eigen::Index k = 0; k < 128; ++k) all(i, k) = std::abs(all(i, k) + noise(generator));
    }
    return in_bytes(all);
  }

 private:
  FloatDescriptors descriptors(std::size_t seed, float spread) const {
    std::mt19937 generator(static_cast<unsigned>(seed));
    std::normal_distribution<float> about(0.0F, spread);
    auto common = common_;
    FloatDescriptors all(kFeatures, 128);
    for (Eigen::Index i = 0; i < all.rows(); ++i) {
      all.row(i) = centres_.row(common(generator));
      for (Eigen::Index k = 0; k < 128; ++k) all(i, k) = std::abs(all(i, k) + about(generator));
    }
    return all;
  }

  std::size_t places_;
  FloatDescriptors centres_;
  std::discrete_distribution<int> common_;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double resident_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t keyframes = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 20000;
  const std::size_t places = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 2000;
  const Street street(places);
  const auto now = [] { return std::chrono::steady_clock::now(); };

  auto start = now();
  std::vector<Descriptors8> samples;
  // 60 000 descriptors are learned of, whatever the drive: 200 keyframes have more than that.
  for (std::size_t i = 0; i < keyframes; i += std::max<std::size_t>(keyframes / 200, 1)) {
    samples.push_back(street.seen_by(i));
  }
  std::vector<const Descriptors8*> pointers;
  for (const Descriptors8& one : samples) pointers.push_back(&one);
  start = now();
  const Vocabulary vocabulary = Vocabulary::learn(pointers);
  const double learned = seconds_since(start);

  double worded = 0.0;
  std::vector<std::vector<std::uint32_t>> words;
  for (std::size_t i = 0; i < keyframes; ++i) {
    const Descriptors8 one = street.seen_by(i);
    start = now();
    words.push_back(vocabulary.words_of(one));
    worded += seconds_since(start);
  }
  samples.clear();
  const double before = resident_mb();
  start = now();
  const PlaceIndex index(words, vocabulary.size());
  const double indexed = seconds_since(start);

  std::vector<double> queries;
  std::size_t again = 0, found = 0;
  for (std::size_t i = 0; i < keyframes; ++i) {
    const std::size_t end = i > 20 ? i - 20 : 0;
    start = now();
    const std::vector<AlikePlace> alike = index.alike(i, end, 4, 3);
    queries.push_back(1e3 * seconds_since(start));
    if (i < places + 20) continue;
    ++again;
    found += std::any_of(alike.begin(), alike.end(), [&](const AlikePlace& place) {
      return place.keyframe % places == i % places;
    });
  }
  const std::size_t tenth = std::max<std::size_t>(keyframes / 10, 1);
  const double late =
      std::accumulate(queries.end() - static_cast<std::ptrdiff_t>(tenth), queries.end(), 0.0) /
      static_cast<double>(tenth);
  const double count = static_cast<double>(keyframes);
  std::printf("keyframes %zu of %zu places, %zu words learned in %.1f s\n", keyframes, places,
              vocabulary.size(), learned);
  std::printf(
      "ms a keyframe: words %.2f, index %.3f, query mean %.2f, of the last tenth %.2f, "
      "largest %.2f\n",
      1e3 * worded / count, 1e3 * indexed / count,
      std::accumulate(queries.begin(), queries.end(), 0.0) / count, late,
      *std::max_element(queries.begin(), queries.end()));
  std::printf("resident: %.0f MB with words, %.0f MB at most with the index\n", before,
              resident_mb());
  std::printf("of %zu keyframes of later laps, %zu have their place among the first four\n", again,
              found);
}
