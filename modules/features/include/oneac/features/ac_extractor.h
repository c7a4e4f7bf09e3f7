#pragma once

#include "oneac/base/image.h"
#include "oneac/geometry/affine_correspondence.h"

#include <memory>
#include <string>
#include <vector>

namespace oneac {

/// What an extractor keeps of one image; only the extractor that made it can read it.
class FrameFeatures {
 public:
  FrameFeatures() = default;
  virtual ~FrameFeatures() = default;
  FrameFeatures(const FrameFeatures&) = delete;
  FrameFeatures& operator=(const FrameFeatures&) = delete;
};

/// Turns image pairs into affine correspondences in two steps, so that what concerns one image is
/// done once and on any thread. Stateless: the result depends on the arguments alone.
class AcExtractor {
 public:
  AcExtractor() = default;
  virtual ~AcExtractor() = default;
  AcExtractor(const AcExtractor&) = delete;
  AcExtractor& operator=(const AcExtractor&) = delete;

  /// Everything that needs one image only. Thread-safe. @pre the image is not empty
  [[nodiscard]] virtual std::shared_ptr<const FrameFeatures> prepare(
      const ImageView& image) const = 0;

  /// Correspondences between two prepared images, x1, x2 in pixels, A = ∂u2/∂u1. Thread-safe.
  [[nodiscard]] virtual std::vector<AffineCorrespondence> correspond(
      const FrameFeatures& first, const FrameFeatures& second) const = 0;
};

struct FeatureOptions;

/// What FeatureOptions::extractor may be: klt, vlfeat, vlfeat+align, sift.
[[nodiscard]] const std::vector<std::string>& extractor_names();

/// Makes the matching part of the extractor named in the options ("klt" has none, and the alignment
/// of "vlfeat+align" and "sift" is make_tracker()'s).
/// @throws std::invalid_argument when the name or an option is not valid
[[nodiscard]] std::unique_ptr<AcExtractor> make_extractor(const FeatureOptions& options);

}  // namespace oneac
