#pragma once

#include "landmark_pose.h"

#include "oneac/base/image.h"
#include "oneac/features/affine_features.h"
#include "oneac/features/sift_pairs.h"
#include "oneac/loops/loop_closer.h"
#include "oneac/loops/loop_constraint.h"

#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace oneac::internal {

/// What one keyframe shows, for as long as a pair is compared.
struct View {
  std::size_t keyframe = 0;
  AffineFeatures features;
  GreyImage image;
};

/// Depth of a feature of a keyframe.
struct FeatureDepth {
  double inverse_depth = 0.0;  ///< [1/m]
  double sigma = 0.0;          ///< [1/m]
  /// Where neighbours see it, A = ∂x/∂(the feature's); when patches are kept.
  SharedPatch sightings;
};

/// Depths by the centres of features [px], to the bit.
using FeatureDepths = std::map<std::pair<double, double>, FeatureDepth>;

/// Two views of a drive compared: by neighbours for depths, by strangers for a loop.
class Verification {
 public:
  Verification(const LoopOptions& options, const LoopCamera& camera);

  [[nodiscard]] AffineFeatures detect(const ImageView& image, const ImageView& mask) const {
    return pairs_.detect(image, mask);
  }
  /// Depths of the features of a view by another whose motion is known.
  /// @param T_2_1  from the view to the other [m]
  void add_depths(const View& view, const View& other, const RelativePose& T_2_1,
                  FeatureDepths& depths) const;
  /// The motion between two keyframes, in metres, where images and landmarks carry it.
  [[nodiscard]] std::optional<LoopConstraint> verify(const View& first,
                                                     const FeatureDepths& depths1,
                                                     const View& second,
                                                     const FeatureDepths& depths2) const;

 private:
  [[nodiscard]] std::optional<LoopConstraint> accepted(const LandmarkPose& pose,
                                                       const std::vector<std::size_t>& acs) const;

  /// Where a view shows a point [px], the other end of a correspondence.
  [[nodiscard]] PatchSighting sighting(std::size_t keyframe, const Correspondence& pair,
                                       double noise_px) const;
  /// The feature of the first view in both and in their neighbours.
  [[nodiscard]] SharedPatch patch_of(const Correspondence& pair, const View& first,
                                     const FeatureDepths& depths1, const View& second,
                                     const FeatureDepths& depths2) const;

  LoopOptions options_;
  PinholeCamera camera_;
  Eigen::Matrix3d R_level_cam_;
  SiftPairs pairs_;
};

}  // namespace oneac::internal
