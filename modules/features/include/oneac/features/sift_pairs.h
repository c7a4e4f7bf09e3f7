#pragma once

#include "oneac/base/image.h"
#include "oneac/features/affine_features.h"
#include "oneac/features/correspondence.h"
#include "oneac/features/feature_options.h"

#include <memory>
#include <vector>

namespace oneac {

/// SIFT of single images, and pairs of them matched and photometrically aligned later: images that
/// lie far apart in a drive, whose features were found once. Any thread.
class SiftPairs {
 public:
  /// @param options  vlfeat (size, number), match, klt (gates of the alignment) and mask apply
  /// @param unused   dark (0) where the images show the car; empty: nowhere
  /// @throws std::invalid_argument for options out of bounds
  explicit SiftPairs(const FeatureOptions& options, GreyImage unused = {});
  ~SiftPairs();
  SiftPairs(const SiftPairs&) = delete;
  SiftPairs& operator=(const SiftPairs&) = delete;

  /// Features outside the masks. @pre the image is not empty
  /// @param mask  of this image alone: dark (below 128) where it is not used; empty: all of it is
  /// @throws InputError when the mask of the options has another size, std::invalid_argument when
  /// that of the image has
  [[nodiscard]] AffineFeatures detect(const ImageView& image, const ImageView& mask = {}) const;
  /// Matches of features [px], x2 and A aligned by grey values with gain and bias. x1 is the centre
  /// of a feature of the first image, x2 − moved that of one of the second.
  /// @pre features of these images
  [[nodiscard]] std::vector<Correspondence> match(const AffineFeatures& first,
                                                  const AffineFeatures& second,
                                                  const ImageView& first_image,
                                                  const ImageView& second_image) const;

 private:
  struct Masks;
  FeatureOptions options_;
  std::unique_ptr<const Masks> masks_;
};

}  // namespace oneac
