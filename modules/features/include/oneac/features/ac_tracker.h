#pragma once

#include "oneac/base/image.h"
#include "oneac/features/ac_extractor.h"
#include "oneac/features/correspondence.h"
#include "oneac/geometry/camera.h"
#include "oneac/geometry/relative_pose.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace oneac {

class Workers;

/// What is known about the motion before the images are compared; all of it may be missing.
struct MotionHint {
  PinholeCamera camera;
  std::optional<RelativePose> T_2_1;  ///< expected motion, t in camera heights when `scaled`
  bool scaled = false;                ///< |T_2_1.t| is in camera heights, else unknown
  Eigen::Matrix3d R_level_cam = Eigen::Matrix3d::Identity();  ///< removes the camera's tilt
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
  /// @param mask  of the image's size: dark (below 128) where it is not used; empty: all of it is
  /// @throws std::invalid_argument for a mask of another size
  [[nodiscard]] virtual std::shared_ptr<const FrameFeatures> prepare(
      const ImageView& image, const ImageView& mask = {}) const = 0;
  /// Correspondences [px] from the last frame given to this one; none for the first.
  [[nodiscard]] virtual TrackedPair advance(std::shared_ptr<const FrameFeatures> now,
                                            const MotionHint& hint) = 0;
  /// Forgets all tracks: the next frame is a first one.
  virtual void reset() = 0;
  /// What belongs to the car as learned so far: black (0) where it does, white (255) elsewhere, of
  /// the images' size. Empty while nothing was learned, and for trackers that do not learn.
  [[nodiscard]] virtual GreyImage car_mask() const { return {}; }
  /// Whether more of the images looked like the car than a drive can lose, so that none is masked.
  [[nodiscard]] virtual bool car_mask_refused() const { return false; }
  /// Whether what is fixed to the car has been told from the scene by now, or need not be: before,
  /// and with trackers that do not learn, what rests in the images may be the car's own.
  [[nodiscard]] virtual bool knows_car() const { return false; }
  /// Whether the image given last shows travel since the one before, whatever its tracks do.
  [[nodiscard]] virtual bool shows_travel() const { return false; }
  /// Whether a tenth of what had to move lately rested in the images: there are drops or dirt on
  /// the glass, and what rests does not tell that the camera does.
  [[nodiscard]] virtual bool views_through_dirt() const { return false; }
  /// What of the images is not used: dark where a mask was given (of this image or of the one
  /// before) or the car is known to be, of the images' size; empty where all is used. Valid until
  /// the next call of advance().
  [[nodiscard]] virtual ImageView unused() const { return {}; }
};

/// Makes the tracker named in the options; matching extractors are wrapped, their tracks chained
/// through the features that two pairs share.
/// @param workers  who shares the work of advance() where it can be ("klt"), and nothing else
///                 meanwhile; none: the calling thread alone. The correspondences are the same
/// @throws std::invalid_argument when the name or an option is not valid
[[nodiscard]] std::unique_ptr<AcTracker> make_tracker(const FeatureOptions& options,
                                                      std::shared_ptr<Workers> workers = nullptr);

}  // namespace oneac
