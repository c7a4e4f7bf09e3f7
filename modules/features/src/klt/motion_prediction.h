#pragma once

#include "motion_correction.h"
#include "patch/patch_window.h"

#include "oneac/features/ac_tracker.h"

#include <Eigen/Core>

#include <optional>

namespace oneac::internal {

/// Where a point is expected, and what of the way there is the translation's [px].
struct ExpectedPlace {
  Eigen::Vector2d u = Eigen::Vector2d::Zero();
  Eigen::Vector2d by_travel = Eigen::Vector2d::Zero();
};

/// Where patches go according to the motion that is expected.
class MotionPrediction {
 public:
  explicit MotionPrediction(const MotionHint& hint);

  /// Points at infinity: what the rotation alone does. Empty without a hint.
  [[nodiscard]] std::optional<PatchWarp> far_away(const Eigen::Vector2d& u1) const;
  /// Points of the road, one camera height below. Empty without a metric hint and above the
  /// horizon.
  [[nodiscard]] std::optional<PatchWarp> on_road(const Eigen::Vector2d& u1) const;

  /// Where a point that went from u0 to u1 in the pair before goes now, by the depth that it showed
  /// then: the motion expected is taken for that of both pairs. Empty without a hint, and for a
  /// point that did not move as the scene does.
  [[nodiscard]] std::optional<ExpectedPlace> goes_on(const Eigen::Vector2d& u0,
                                                     const Eigen::Vector2d& u1) const;
  /// The same motion with what it lacks.
  [[nodiscard]] MotionPrediction corrected(const MotionCorrection& correction) const;
  [[nodiscard]] const PinholeCamera& camera() const { return camera_; }
  /// Whether there is a motion to go by.
  [[nodiscard]] bool is_known() const { return motion_.has_value(); }

  /// Whether on_road() can say anything.
  [[nodiscard]] bool is_metric() const { return road_.has_value(); }

 private:
  void set_motion(const RelativePose& motion, bool scaled);

  PinholeCamera camera_;
  Eigen::Vector3d down_ = Eigen::Vector3d::UnitY();  ///< in the camera frame
  std::optional<RelativePose> motion_;
  std::optional<Eigen::Matrix3d> far_, road_;  ///< homographies of normalised points
};

}  // namespace oneac::internal
