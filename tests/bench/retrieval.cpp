// What finding alike places costs over a long drive: words of every keyframe, the inverted index, a
// query by every keyframe.
//
//   oneac_bench_retrieval [KEYFRAMES [PLACES]]     laps of PLACES keyframes, 20000 and 2000 by
//   default
//
// All is simulated. 200 keyframes have descriptors, 700 each, drawn about 3000 centres that are as
// unequally common as 1/rank: they teach the vocabulary and tell what finding words costs and how
// common each word is. All keyframes then have 700 words of that distribution: a place has its own,
// of which half are seen again a lap later, and others stand in. No image is read, nothing is
// verified: retrieval alone. Times are CPU times.
#include "place_index.h"
#include "vocabulary.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numeric>
#include <random>
#include <vector>

namespace {

using namespace oneac::internal;

constexpr int kFeatures = 700, kCentres = 3000;
constexpr unsigned kSamples = 200;
constexpr float kSpread = 0.05F;  // of entries of unit vectors

/// Descriptors of a keyframe out of nowhere.
FloatDescriptors descriptors(unsigned seed, const FloatDescriptors& centres,
                             std::discrete_distribution<int> common) {
  std::mt19937 generator(seed);
  std::normal_distribution<float> about(0.0F, kSpread);
  FloatDescriptors all(kFeatures, 128);
  for (Eigen::Index i = 0; i < all.rows(); ++i) {
    all.row(i) = centres.row(common(generator));
    for (Eigen::Index k = 0; k < 128; ++k) all(i, k) = std::abs(all(i, k) + about(generator));
  }
  return all;
}

std::vector<Descriptors8> sample_keyframes() {
  std::mt19937 generator(7);
  std::exponential_distribution<float> entry(1.0F);
  FloatDescriptors centres(kCentres, 128);
  for (Eigen::Index i = 0; i < centres.size(); ++i) centres.data()[i] = entry(generator);
  centres.rowwise().normalize();
  std::vector<double> share(kCentres);
  for (std::size_t i = 0; i < share.size(); ++i) share[i] = 1.0 / static_cast<double>(i + 1);
  const std::discrete_distribution<int> common(share.begin(), share.end());
  std::vector<Descriptors8> samples;
  for (unsigned i = 0; i < kSamples; ++i) {
    samples.push_back(in_bytes(descriptors(i, centres, common)));
  }
  return samples;
}

/// Words of a keyframe: half are its place's.
std::vector<std::uint32_t> words_of_place(std::size_t keyframe, std::size_t places,
                                          std::discrete_distribution<std::uint32_t> common) {
  std::mt19937 of_place(static_cast<unsigned>(keyframe % places));
  std::mt19937 own(static_cast<unsigned>(keyframe) + 1000003U);
  auto other = common;
  std::bernoulli_distribution again(0.5);
  std::vector<std::uint32_t> words;
  for (int i = 0; i < kFeatures; ++i) {
    const std::uint32_t seen = common(of_place), instead = other(own);
    words.push_back(again(own) ? seen : instead);
  }
  return words;
}

double cpu_seconds_since(std::clock_t start) {
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
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
  const std::vector<Descriptors8> samples = sample_keyframes();
  std::vector<const Descriptors8*> pointers;
  for (const Descriptors8& one : samples) pointers.push_back(&one);
  std::clock_t start = std::clock();
  const Vocabulary vocabulary = Vocabulary::learn(pointers);
  const double learned = cpu_seconds_since(start);

  std::vector<double> frequency(vocabulary.size(), 0.0);
  start = std::clock();
  for (const Descriptors8& one : samples) {
    for (const std::uint32_t word : vocabulary.words_of(one)) frequency[word] += 1.0;
  }
  const double worded = cpu_seconds_since(start) / kSamples;
  const std::discrete_distribution<std::uint32_t> common(frequency.begin(), frequency.end());
  std::vector<std::vector<std::uint32_t>> words;
  for (std::size_t i = 0; i < keyframes; ++i) words.push_back(words_of_place(i, places, common));
  const double before = resident_mb();
  start = std::clock();
  const PlaceIndex index(words, vocabulary.size());
  const double indexed = cpu_seconds_since(start);

  std::vector<double> queries;
  std::size_t again = 0, found = 0;
  const std::size_t step = std::max<std::size_t>(keyframes / 2000, 1);  // 2000 queries tell
  for (std::size_t i = 0; i < keyframes; i += step) {
    const std::size_t end = i > 20 ? i - 20 : 0;
    start = std::clock();
    const std::vector<AlikePlace> alike = index.alike(i, end, 4, 3);
    queries.push_back(1e3 * cpu_seconds_since(start));
    if (i < places + 20) continue;
    ++again;
    found += std::any_of(alike.begin(), alike.end(), [&](const AlikePlace& place) {
      return place.keyframe % places == i % places;
    });
  }
  const std::size_t tenth = std::max<std::size_t>(queries.size() / 10, 1);
  const double late =
      std::accumulate(queries.end() - static_cast<std::ptrdiff_t>(tenth), queries.end(), 0.0) /
      static_cast<double>(tenth);
  const double count = static_cast<double>(keyframes);
  std::printf("keyframes %zu of %zu places, %zu words learned in %.1f s\n", keyframes, places,
              vocabulary.size(), learned);
  std::printf(
      "ms a keyframe: words %.2f, index %.3f, query mean %.2f, of the last tenth %.2f, "
      "largest %.2f\n",
      1e3 * worded, 1e3 * indexed / count,
      std::accumulate(queries.begin(), queries.end(), 0.0) / static_cast<double>(queries.size()),
      late, *std::max_element(queries.begin(), queries.end()));
  std::printf("resident: %.0f MB with words, %.0f MB at most with the index\n", before,
              resident_mb());
  std::printf("of %zu keyframes of later laps, %zu have their place among the first four\n", again,
              found);
}
