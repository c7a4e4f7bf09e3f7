#include "oneac/features/sift_pairs.h"

#include "feature_mask.h"
#include "patch/patch_flow.h"
#include "with_quality.h"

#include "oneac/features/descriptor_matching.h"
#include "oneac/features/sift_extractor.h"

#include <cmath>
#include <cstddef>
#include <utility>

namespace oneac {
namespace {

constexpr int kAlignmentLevels = 2;  // as other matched features are aligned

/// Whether the picture is light there, or ends before.
bool is_light(const GreyImage& picture, const Eigen::Vector2d& u) {
  const auto column = static_cast<int>(std::lround(u.x()));
  const auto row = static_cast<int>(std::lround(u.y()));
  if (column < 0 || row < 0 || column >= picture.width() || row >= picture.height()) return true;
  return picture.row(row)[column] != 0;
}

}  // namespace

struct SiftPairs::Masks {
  internal::FeatureMask given;
  GreyImage car;

  [[nodiscard]] bool usable(const Eigen::Vector2d& u) const {
    return given.usable(u) && is_light(car, u);
  }
};

SiftPairs::SiftPairs(const FeatureOptions& options, GreyImage unused) : options_(options) {
  options_.validate();
  masks_ =
      std::make_unique<const Masks>(Masks{internal::FeatureMask(options.mask), std::move(unused)});
}

SiftPairs::~SiftPairs() = default;

AffineFeatures SiftPairs::detect(const ImageView& image, const ImageView& mask) const {
  masks_->given.require_size(image.width, image.height);
  const GreyImage of_image = internal::mask_of_image(image, mask);
  AffineFeatures all = detect_sift(image, options_.vlfeat);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < all.frames.size(); ++i) {
    const Eigen::Vector2d& u = all.frames[i].centre;
    if (masks_->usable(u) && usable_in(of_image, u)) kept.push_back(i);
  }
  AffineFeatures features;
  features.descriptors.resize(static_cast<Eigen::Index>(kept.size()), 128);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    features.frames.push_back(all.frames[kept[i]]);
    features.descriptors.row(static_cast<Eigen::Index>(i)) =
        all.descriptors.row(static_cast<Eigen::Index>(kept[i]));
  }
  return features;
}

std::vector<Correspondence> SiftPairs::match(const AffineFeatures& first,
                                             const AffineFeatures& second,
                                             const ImageView& first_image,
                                             const ImageView& second_image) const {
  const internal::ImagePyramid from = internal::build_pyramid(first_image, kAlignmentLevels);
  const internal::ImagePyramid to = internal::build_pyramid(second_image, kAlignmentLevels);
  internal::PatchFlow flow(from, to, options_.klt);
  std::vector<Correspondence> pairs;
  for (const AffineCorrespondence& ac : match_features(first, second, options_.match)) {
    internal::PatchWarp start;
    start.M = ac.A;
    start.centre = ac.x2;
    const auto found = flow.refine(ac.x1, start, {});
    if (!found) continue;
    const AffineCorrespondence aligned{ac.x1, found->warp.centre, found->warp.M};
    pairs.push_back(internal::with_quality(aligned, pairs.size(), found->quality));
    pairs.back().moved = aligned.x2 - ac.x2;
  }
  return pairs;
}

}  // namespace oneac
