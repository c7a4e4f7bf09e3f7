#pragma once

#include "klt_track.h"
#include "patch/patch_flow.h"

#include "oneac/features/affine_features.h"
#include "oneac/features/feature_options.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace oneac::internal {

/// A patch that was found again without a track.
struct Rematch {
  Eigen::Vector2d u1 = Eigen::Vector2d::Zero();  ///< in the first image [px]
  PatchMatch match;
};

/// The wide-baseline middle way for when tracking breaks: SIFT features of both images, matched by
/// their descriptors; A starts as the similarity of scale and orientation and is then aligned.
class Rematcher {
 public:
  explicit Rematcher(const FeatureOptions& options) : options_(options) {}

  /// Detects in both images, but not again in one that was the second of the call before.
  [[nodiscard]] std::vector<Rematch> match(const std::shared_ptr<const KltFrame>& first,
                                           const std::shared_ptr<const KltFrame>& second);

 private:
  FeatureOptions options_;
  std::weak_ptr<const KltFrame> last_;  ///< whose features these are
  AffineFeatures features_;
};

}  // namespace oneac::internal
