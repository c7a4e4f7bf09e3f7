#pragma once

#include "feature_mask.h"
#include "patch/image_pyramid.h"

#include "oneac/features/ac_tracker.h"
#include "oneac/features/feature_options.h"

#include <map>
#include <memory>
#include <utility>

namespace oneac::internal {

/// An extractor that matches pairs, as a tracker: a feature of the middle frame that takes part in
/// two pairs carries the track on. Optionally each match is aligned photometrically, which moves x2
/// and A; x1 stays the feature's place, so x2 of one pair and x1 of the next differ by the
/// detector's error.
class MatchedTracker : public AcTracker {
 public:
  MatchedTracker(const FeatureOptions& options, std::unique_ptr<AcExtractor> extractor, bool align);

  [[nodiscard]] std::shared_ptr<const FrameFeatures> prepare(
      const ImageView& image, const ImageView& mask = {}) const override;
  [[nodiscard]] TrackedPair advance(std::shared_ptr<const FrameFeatures> now,
                                    const MotionHint& hint) override;
  void reset() override;
  [[nodiscard]] ImageView unused() const override {
    return masked_.empty() ? unused_.view() : masked_.view();
  }

 private:
  struct Frame : FrameFeatures {
    std::shared_ptr<const FrameFeatures> features;
    ImagePyramid pyramid;       ///< when aligned
    GreyImage mask;             ///< of this image alone
    int width = 0, height = 0;  ///< [px]
  };
  using Place = std::pair<double, double>;  ///< a feature's centre: the same bytes in both pairs

  [[nodiscard]] bool usable(const AffineCorrespondence& ac, const Frame& now) const;
  /// Number of the track that a match carries on or begins, as it was aligned.
  [[nodiscard]] std::uint64_t carry_on(const AffineCorrespondence& matched,
                                       const std::map<Place, std::uint64_t>& known);

  FeatureOptions options_;
  FeatureMask mask_;
  GreyImage unused_;  ///< by the mask
  GreyImage masked_;  ///< by the masks of single images, too; empty without them
  std::unique_ptr<AcExtractor> extractor_;
  bool align_;
  std::shared_ptr<const Frame> last_;
  std::map<Place, std::uint64_t> tracks_;  ///< by the place in the last frame
  std::uint64_t next_id_ = 0;
};

}  // namespace oneac::internal
