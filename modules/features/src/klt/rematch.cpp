#include "rematch.h"

#include "oneac/base/image.h"
#include "oneac/features/descriptor_matching.h"
#include "oneac/features/sift_extractor.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace oneac::internal {
namespace {

/// The finest level as an ordinary image, so that no frame has to keep its own for the rare break.
GreyImage picture_of(const PyramidLevel& level) {
  GreyImage image(level.width, level.height);
  for (int v = 0; v < level.height; ++v) {
    std::transform(level.row(v), level.row(v) + level.width, image.row(v), [](std::uint16_t grey) {
      return static_cast<std::uint8_t>(std::min((grey + 8) >> 4, 255));
    });
  }
  return image;
}

AffineFeatures features_of(const KltFrame& frame, const VlfeatOptions& options) {
  return detect_sift(picture_of(frame.pyramid.levels.front()).view(), options);
}

}  // namespace

std::vector<Rematch> Rematcher::match(const std::shared_ptr<const KltFrame>& first,
                                      const std::shared_ptr<const KltFrame>& second) {
  const bool known = last_.lock() == first;
  const AffineFeatures before = known ? std::move(features_) : features_of(*first, options_.vlfeat);
  features_ = features_of(*second, options_.vlfeat);
  last_ = second;
  PatchFlow flow(first->pyramid, second->pyramid, options_.klt);
  std::vector<Rematch> found;
  for (const AffineCorrespondence& ac : match_features(before, features_, options_.match)) {
    PatchWarp similarity;
    similarity.M = ac.A;
    similarity.centre = ac.x2;
    const auto match = flow.refine(ac.x1, similarity, {});
    if (match) found.push_back({ac.x1, *match});
  }
  return found;
}

}  // namespace oneac::internal
