#pragma once

#include "patch/patch_window.h"

#include "oneac/features/ac_tracker.h"

#include <Eigen/Core>

#include <optional>

namespace oneac::internal {

/// Where patches go according to the motion that is expected.
class MotionPrediction {
 public:
  explicit MotionPrediction(const MotionHint& hint);

  /// Points at infinity: what the rotation alone does. Empty without a hint.
  [[nodiscard]] std::optional<PatchWarp> far_away(const Eigen::Vector2d& u1) const;
  /// Points of the road, one camera height below. Empty without a metric hint and above the
  /// horizon.
  [[nodiscard]] std::optional<PatchWarp> on_road(const Eigen::Vector2d& u1) const;

  /// Whether on_road() can say anything.
  [[nodiscard]] bool is_metric() const { return road_.has_value(); }

 private:
  PinholeCamera camera_;
  Eigen::Vector3d down_ = Eigen::Vector3d::UnitY();  ///< in the camera frame
  std::optional<Eigen::Matrix3d> far_, road_;        ///< homographies of normalised points
};

}  // namespace oneac::internal
