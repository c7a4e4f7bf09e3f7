#pragma once

#include "oneac/features/ac_extractor.h"
#include "oneac/features/affine_features.h"
#include "oneac/features/feature_options.h"

namespace oneac {

/// DoG interest points, affine shape adaptation (Baumberg), orientation and RootSIFT by VLFeat.
[[nodiscard]] AffineFeatures detect_vlfeat(const ImageView& image, const VlfeatOptions& options);

/// The paper's extractor: detect_vlfeat on each image, match_features on the pair.
class VlfeatExtractor : public AcExtractor {
 public:
  /// @pre options.validate() passes
  explicit VlfeatExtractor(const FeatureOptions& options) : options_(options) {}
  [[nodiscard]] std::shared_ptr<const FrameFeatures> prepare(const ImageView& image) const override;
  [[nodiscard]] std::vector<AffineCorrespondence> correspond(
      const FrameFeatures& first, const FrameFeatures& second) const override;

 private:
  FeatureOptions options_;
};

}  // namespace oneac
