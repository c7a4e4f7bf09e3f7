#include "vocabulary.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace oneac::internal {
namespace {

constexpr int kBranches = 10, kDepth = 4;  // 10 000 words: 700 features are a few per cent of them
constexpr Eigen::Index kMostSamples = 60000;  // six a word; enough for centres, 30 MB
constexpr Eigen::Index kFewest = 60;          // descriptors of a node that is divided further
constexpr int kRounds = 8;                    // of Lloyd; words need no optimum

/// Evenly out of all keyframes.
FloatDescriptors samples_of(const std::vector<const Descriptors8*>& keyframes) {
  Eigen::Index all = 0;
  for (const Descriptors8* one : keyframes) all += one->rows();
  const Eigen::Index every = all / kMostSamples + 1;
  FloatDescriptors samples((all + every - 1) / every, 128);
  Eigen::Index seen = 0, row = 0;
  for (const Descriptors8* one : keyframes) {
    for (Eigen::Index i = 0; i < one->rows(); ++i, ++seen) {
      if (seen % every == 0) samples.row(row++) = one->row(i).cast<float>() / 255.0F;
    }
  }
  return samples;
}

/// Clusters of the rows; labels in 0 … kBranches − 1. OpenCV draws from the thread's generator.
cv::Mat cluster(cv::Mat rows, std::vector<int>& labels) {
  constexpr std::uint64_t kState = 20241129;
  cv::RNG& generator = cv::theRNG();
  const std::uint64_t before = generator.state;
  generator.state = kState;
  cv::Mat found, centres;
  cv::kmeans(rows, kBranches, found, {cv::TermCriteria::COUNT, kRounds, 0.0}, 1,
             cv::KMEANS_PP_CENTERS, centres);
  generator.state = before;
  labels.assign(found.begin<int>(), found.end<int>());
  return centres;
}

}  // namespace

Vocabulary Vocabulary::learn(const std::vector<const Descriptors8*>& keyframes) {
  Vocabulary vocabulary;
  const FloatDescriptors samples = samples_of(keyframes);
  std::vector<Eigen::Index> rows(static_cast<std::size_t>(samples.rows()));
  std::iota(rows.begin(), rows.end(), Eigen::Index{0});
  vocabulary.nodes_.emplace_back();
  vocabulary.grow(0, samples, rows, 0);
  return vocabulary;
}

void Vocabulary::grow(std::uint32_t node, const FloatDescriptors& samples,
                      const std::vector<Eigen::Index>& rows, int depth) {
  if (depth == kDepth || static_cast<Eigen::Index>(rows.size()) < kFewest) {
    nodes_[node].word = static_cast<std::uint32_t>(leaves_++);
    return;
  }
  cv::Mat own(static_cast<int>(rows.size()), 128, CV_32F);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::copy_n(samples.row(rows[i]).data(), 128, own.ptr<float>(static_cast<int>(i)));
  }
  std::vector<int> labels;
  const cv::Mat centres = cluster(own, labels);
  nodes_[node].centres.resize(kBranches, 128);
  for (int branch = 0; branch < kBranches; ++branch) {
    std::copy_n(centres.ptr<float>(branch), 128, nodes_[node].centres.row(branch).data());
    std::vector<Eigen::Index> members;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (labels[i] == branch) members.push_back(rows[i]);
    }
    const auto child = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    nodes_[node].children.push_back(child);
    grow(child, samples, members, depth + 1);
  }
}

std::uint32_t Vocabulary::word_of(const FloatDescriptor& descriptor) const {
  const Node* node = &nodes_.front();
  while (!node->children.empty()) {
    Eigen::Index nearest = 0;
    (node->centres.rowwise() - descriptor).rowwise().squaredNorm().minCoeff(&nearest);
    node = &nodes_[node->children[static_cast<std::size_t>(nearest)]];
  }
  return node->word;
}

std::vector<std::uint32_t> Vocabulary::words_of(const Descriptors8& descriptors) const {
  std::vector<std::uint32_t> words;
  words.reserve(static_cast<std::size_t>(descriptors.rows()));
  for (Eigen::Index i = 0; i < descriptors.rows(); ++i) {
    words.push_back(word_of(descriptors.row(i).cast<float>() / 255.0F));
  }
  return words;
}

}  // namespace oneac::internal
