#pragma once

#include "descriptors.h"

#include <cstdint>
#include <vector>

namespace oneac::internal {

/// Words of a drive: a tree of cluster centres, ten branches a node.
class Vocabulary {
 public:
  /// Learns the tree by k-means (OpenCV), level by level, with a random state of its own.
  static Vocabulary learn(const std::vector<const Descriptors8*>& keyframes);

  /// The leaf of every descriptor.
  [[nodiscard]] std::vector<std::uint32_t> words_of(const Descriptors8& descriptors) const;
  /// Number of leaves.
  [[nodiscard]] std::size_t size() const { return leaves_; }

 private:
  struct Node {
    FloatDescriptors centres;             ///< of the children; none: a leaf
    std::vector<std::uint32_t> children;  ///< places of nodes
    std::uint32_t word = 0;               ///< of a leaf
  };

  void grow(std::uint32_t node, const FloatDescriptors& samples,
            const std::vector<Eigen::Index>& rows, int depth);
  [[nodiscard]] std::uint32_t word_of(const FloatDescriptor& descriptor) const;

  std::vector<Node> nodes_;
  std::size_t leaves_ = 0;
};

}  // namespace oneac::internal
