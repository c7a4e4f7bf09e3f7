#pragma once

#include "oneac/features/ac_extractor.h"
#include "oneac/features/affine_features.h"
#include "oneac/features/feature_options.h"

namespace oneac {

/// DoG interest points with scale, orientation and RootSIFT by OpenCV. The shape is a similarity;
/// max_features and edge_threshold of the options apply.
[[nodiscard]] AffineFeatures detect_sift(const ImageView& image, const VlfeatOptions& options);

/// detect_sift on each image, match_features on the pair: for motion too large to track. A is a
/// similarity; make_tracker() aligns it afterwards.
class SiftExtractor : public AcExtractor {
 public:
  /// @pre options.validate() passes
  explicit SiftExtractor(const FeatureOptions& options) : options_(options) {}
  [[nodiscard]] std::shared_ptr<const FrameFeatures> prepare(const ImageView& image) const override;
  [[nodiscard]] std::vector<AffineCorrespondence> correspond(
      const FrameFeatures& first, const FrameFeatures& second) const override;

 private:
  FeatureOptions options_;
};

}  // namespace oneac
