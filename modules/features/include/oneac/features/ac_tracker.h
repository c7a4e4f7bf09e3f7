#pragma once

#include "oneac/features/ac_extractor.h"
#include "oneac/geometry/camera.h"
#include "oneac/geometry/relative_pose.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace oneac {

/// What is known about the motion before the images are compared; all of it may be missing.
struct MotionHint {
  PinholeCamera camera;
  std::optional<RelativePose> T_2_1;  ///< expected motion, t in camera heights when `scaled`
  bool scaled = false;                ///< |T_2_1.t| is in camera heights, else unknown
  Eigen::Matrix3d R_level_cam = Eigen::Matrix3d::Identity();  ///< removes the camera's tilt
};

/// Correspondences from the frame before to this one, each part of a track over many frames.
struct TrackedPair {
  std::vector<AffineCorrespondence> acs;  ///< pixels, A = ∂u2/∂u1
  std::vector<std::uint64_t> tracks;      ///< one per correspondence; the same number in every pair
                                          ///< that the track lives through, never used twice
  std::vector<float> affine_sigma;        ///< 1σ of an entry of A [-]; 0 where unknown
  std::vector<float> point_sigma;         ///< 1σ of u2 [px]; 0 where unknown
  /// K [px²]: a patch that maps as δ ↦ A δ (1 − η·δ), which perspective does, is found with its
  /// centre u2 shifted by −A K η; zero where unknown.
  std::vector<Eigen::Matrix2f> perspective;
  bool standing = false;  ///< the images are near-identical: the camera stood
};

/// Follows affine frames through a sequence of images. prepare() holds all that concerns one image
/// and runs on any thread; advance() goes image by image, in time order, and keeps the tracks.
class AcTracker {
 public:
  AcTracker() = default;
  virtual ~AcTracker() = default;
  AcTracker(const AcTracker&) = delete;
  AcTracker& operator=(const AcTracker&) = delete;

  /// Everything that needs one image only. Thread-safe. @pre the image is not empty
  [[nodiscard]] virtual std::shared_ptr<const FrameFeatures> prepare(
      const ImageView& image) const = 0;
  /// Correspondences from the last frame given to this one; none for the first.
  [[nodiscard]] virtual TrackedPair advance(std::shared_ptr<const FrameFeatures> now,
                                            const MotionHint& hint) = 0;
  /// Forgets all tracks: the next frame is a first one.
  virtual void reset() = 0;
};

/// Makes the tracker named in the options; matching extractors are wrapped, their tracks chained
/// through the features that two pairs share.
/// @throws std::invalid_argument when the name or an option is not valid
[[nodiscard]] std::unique_ptr<AcTracker> make_tracker(const FeatureOptions& options);

}  // namespace oneac
