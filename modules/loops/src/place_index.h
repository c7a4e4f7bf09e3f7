#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace oneac::internal {

/// A keyframe that looks like the one asked for.
struct AlikePlace {
  std::size_t keyframe = 0;
  double score = 0.0;  ///< cosine of the tf-idf vectors, 0 … 1
};

/// Inverted index of keyframes by their words.
class PlaceIndex {
 public:
  /// @param words       of each keyframe
  /// @param vocabulary  number of words
  PlaceIndex(const std::vector<std::vector<std::uint32_t>>& words, std::size_t vocabulary);

  /// Keyframes before `end` by their similarity to a keyframe, best first, at most `most`; one of
  /// several within `apart` keyframes of each other.
  [[nodiscard]] std::vector<AlikePlace> alike(std::size_t keyframe, std::size_t end,
                                              std::size_t most, std::size_t apart) const;

 private:
  struct Entry {
    std::uint32_t place;  ///< keyframe of a posting, word of a vector
    float weight;
  };
  using Vector = std::vector<Entry>;

  std::vector<Vector> vectors_;   ///< per keyframe: words and weights, unit length
  std::vector<Vector> postings_;  ///< per word: keyframes and weights
};

}  // namespace oneac::internal
