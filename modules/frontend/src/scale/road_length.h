#pragma once

#include "attitude/levelling.h"
#include "measurements.h"

#include "oneac/robust/ground_scale.h"
#include "oneac/solvers/span.h"

#include <optional>
#include <vector>

namespace oneac {

/// Lengths by the road and the camera's height above it.
class RoadLength {
 public:
  /// @param threshold_px  [px] bound of an inlier
  RoadLength(const GroundScaleOptions& options, double threshold_px);

  /// [m] of the camera above the road; 0: unknown, then it measures nothing.
  void set_camera_height(double height) { camera_height_ = height; }
  [[nodiscard]] double camera_height() const { return camera_height_; }

  /// |T_2_1.t| [m]; empty without height or enough road.
  /// @param acs      normalised
  /// @param inliers  one per correspondence
  /// @param first    levelling of the first view
  [[nodiscard]] std::optional<LengthMeasurement> measure(AcSpan acs,
                                                         const std::vector<bool>& inliers,
                                                         const RelativePose& T_2_1,
                                                         const Levelling& first,
                                                         double focal_px) const;

 private:
  GroundScaleOptions options_;
  double point_sigma_px_;
  double camera_height_ = 0.0;
};

}  // namespace oneac
