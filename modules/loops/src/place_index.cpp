#include "place_index.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace oneac::internal {
namespace {

using Counts = std::map<std::uint32_t, double>;

Counts counts_of(const std::vector<std::uint32_t>& words) {
  Counts counts;
  for (const std::uint32_t word : words) counts[word] += 1.0;
  return counts;
}

/// log(keyframes / keyframes with the word).
std::vector<double> rarity_of(const std::vector<Counts>& all, std::size_t vocabulary) {
  std::vector<double> rarity(vocabulary, 0.0);
  for (const Counts& counts : all) {
    for (const auto& [word, count] : counts) rarity[word] += 1.0;
  }
  for (double& word : rarity) {
    if (word > 0.0) word = std::log(static_cast<double>(all.size()) / word);
  }
  return rarity;
}

}  // namespace

PlaceIndex::PlaceIndex(const std::vector<std::vector<std::uint32_t>>& words, std::size_t vocabulary)
    : postings_(vocabulary) {
  std::vector<Counts> all;
  for (const auto& of_keyframe : words) all.push_back(counts_of(of_keyframe));
  const std::vector<double> rarity = rarity_of(all, vocabulary);
  for (std::size_t keyframe = 0; keyframe < all.size(); ++keyframe) {
    double squares = 0.0;
    // Many of one word are one texture: they count by their root.
    const auto weight = [&](const auto& entry) {
      return std::sqrt(entry.second) * rarity[entry.first];
    };
    for (const auto& entry : all[keyframe]) squares += weight(entry) * weight(entry);
    Vector& vector = vectors_.emplace_back();
    for (const auto& entry : all[keyframe]) {
      if (!(weight(entry) > 0.0)) continue;
      const auto share = static_cast<float>(weight(entry) / std::sqrt(squares));
      vector.push_back({entry.first, share});
      postings_[entry.first].push_back({static_cast<std::uint32_t>(keyframe), share});
    }
  }
}

std::vector<AlikePlace> PlaceIndex::alike(std::size_t keyframe, std::size_t end, std::size_t most,
                                          std::size_t apart) const {
  std::vector<double> scores(end, 0.0);
  for (const Entry& word : vectors_[keyframe]) {
    for (const Entry& posting : postings_[word.place]) {
      if (posting.place >= end) break;  // they are in order
      scores[posting.place] += static_cast<double>(word.weight) * posting.weight;
    }
  }
  std::vector<AlikePlace> places;
  for (std::size_t i = 0; i < end; ++i) {
    if (scores[i] > 0.0) places.push_back({i, scores[i]});
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
  std::vector<AlikePlace> best;
  for (const AlikePlace& place : places) {
    if (best.size() == most) break;
    const bool near = std::any_of(best.begin(), best.end(), [&](const AlikePlace& other) {
      return std::max(place.keyframe, other.keyframe) - std::min(place.keyframe, other.keyframe) <=
             apart;
    });
    if (!near) best.push_back(place);
  }
  return best;
}

}  // namespace oneac::internal
