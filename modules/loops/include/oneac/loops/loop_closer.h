#pragma once

#include "oneac/base/image.h"
#include "oneac/features/affine_features.h"
#include "oneac/geometry/camera.h"
#include "oneac/loops/loop_constraint.h"
#include "oneac/loops/loop_keyframe.h"
#include "oneac/loops/loop_options.h"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace oneac {

/// What all keyframes of a drive share.
struct LoopCamera {
  PinholeCamera camera;                                       ///< of the rectified images
  Eigen::Matrix3d R_level_cam = Eigen::Matrix3d::Identity();  ///< removes the camera's tilt
  GreyImage unused;          ///< dark where the images show the car; empty: nowhere
  std::string mask_polygon;  ///< MaskOptions of the features
  std::string mask_image;
};

/// What a search met, beside its loops.
struct LoopReport {
  std::size_t keyframes = 0;     ///< that were looked at
  std::size_t not_metric = 0;    ///< of them, without metres: no loop may end there
  std::size_t apart_by_gps = 0;  ///< pairs that look alike and by GPS are far from each other
  std::size_t candidates = 0;    ///< other pairs that look alike
  std::size_t verified = 0;      ///< of them, that share a scene by affine correspondences
  std::size_t impossible = 0;    ///< of these, that odometry or a car's speed contradict
  std::size_t contradicted = 0;  ///< that other loops contradict, too few support, or double
};

struct FoundLoops {
  std::vector<LoopConstraint> loops;  ///< in the order of `second`
  LoopReport report;
};

/// Finds the keyframes of a drive that see a place again, and measures the motion between them in
/// metres.
///
/// Recognition: RootSIFT words of a vocabulary learned of the drive itself, tf-idf, an inverted
/// index; neighbours on the way are left out, and candidates that neighbours do not share.
/// Verification: SIFT aligned by grey values, one-AC consensus, then all six degrees of freedom by
/// the landmarks of both keyframes, triangulated with the metric odometry around each. Acceptance:
/// support on both sides, odometry's covariance, and agreement with the loops nearby. Places passed
/// in the opposite direction look otherwise and are not found.
///
/// Sees no clock and draws no random number: the same loops at any number of threads.
class LoopCloser {
 public:
  /// The image of a keyframe, by its place in the order of adding; empty when there is none. Called
  /// from several threads at once.
  using Images = std::function<GreyImage(std::size_t keyframe)>;
  /// Whether to stop: then the search ends with no loop.
  using Stop = std::function<bool()>;

  /// @throws std::invalid_argument for options or a camera out of bounds
  LoopCloser(const LoopOptions& options, LoopCamera camera, Images images);
  ~LoopCloser();
  LoopCloser(const LoopCloser&) = delete;
  LoopCloser& operator=(const LoopCloser&) = delete;

  /// What add() needs of an image; any thread.
  /// @param mask  of this image alone, as SiftPairs::detect() takes it
  [[nodiscard]] AffineFeatures features(const ImageView& image, const ImageView& mask = {}) const;
  /// The next keyframe, in the order of the drive.
  void add(const LoopKeyframe& keyframe, const AffineFeatures& features);
  /// The loops among all keyframes so far.
  [[nodiscard]] FoundLoops close(int threads, const Stop& stop = {}) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace oneac
