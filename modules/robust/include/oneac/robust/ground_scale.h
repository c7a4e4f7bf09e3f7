#pragma once

#include "oneac/base/bound.h"
#include "oneac/geometry/relative_pose.h"
#include "oneac/solvers/span.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace oneac {

/// Length of a step from the road and the camera's height. validate() throws std::invalid_argument.
struct GroundScaleOptions {
  double max_distance = 15.0;      ///< [camera heights] farther road has no parallax and few pixels
  double max_side = 2.0;           ///< [camera heights] to either side: the lane and a metre or
                                   ///< two; then come other cross falls, kerbs and footways. Twice
                                   ///< that for a camera that looks aside
  double affine_tolerance = 0.25;  ///< [-] |A − A_ground| (Frobenius) of a ground correspondence
  double bandwidth = 0.05;         ///< [-] relative spread of heights that count as the same plane
  int min_support = 8;             ///< ground correspondences needed, and ...
  double max_uncertainty = 0.06;   ///< ... [-] relative 1σ of the length allowed for "metric"
  double plane_tilt_deg = 0.3;     ///< [deg] 1σ of the road's slope ahead against the levelled
                                   ///< camera: a slope that wanders by 1° in 100 m, over 10 m
  double cross_fall_deg = 1.4;     ///< [deg] 1σ of its slope to the side: roads fall by 2.5 %

  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

template <class Visitor>
void describe(Visitor&& visit, GroundScaleOptions& o) {
  visit("max_distance", o.max_distance, "camera heights", "farther road is not used",
        Bound::positive());
  visit("max_side", o.max_side, "camera heights", "road farther to the side is not used",
        Bound::positive());
  visit("affine_tolerance", o.affine_tolerance, "-", "affinity error of a ground correspondence",
        Bound::positive());
  visit("bandwidth", o.bandwidth, "-", "relative spread of heights on one plane",
        Bound::positive());
  visit("min_support", o.min_support, "count", "ground correspondences needed", Bound::at_least(1));
  visit("max_uncertainty", o.max_uncertainty, "-", "relative 1-sigma of a metric length",
        Bound::positive());
  visit("plane_tilt_deg", o.plane_tilt_deg, "deg",
        "1-sigma of the road's slope ahead against the levelled camera", Bound::positive());
  visit("cross_fall_deg", o.cross_fall_deg, "deg", "1-sigma of the road's slope to the side",
        Bound::positive());
}

/// What the road says about the length of one step.
struct GroundScale {
  double baseline = 0.0;     ///< |t| in camera heights
  double uncertainty = 0.0;  ///< relative 1σ of it, from the spread of the support, and from a
                             ///< kerb where a bend looks at what the car does not drive on
  double reach = 0.0;        ///< [heights] root mean square distance ahead of the support
  std::size_t support = 0;   ///< correspondences on the ground plane
};

/// Length of the translation in camera heights from the correspondences on the ground; empty when
/// the support or its agreement does not carry it.
///
/// Each inlier is triangulated with the unit translation and votes for the height Y of the camera
/// above its horizontal plane, weighted by its parallax; the ground is the heaviest mode among
/// correspondences whose affinity agrees with a horizontal plane. The plane is then refined with a
/// slope (IRLS, slope held by its prior): a slope of 0.5° would otherwise change the length by 5 %.
/// Points whose affinities together fit a wall across or along the way better than the road are of
/// parked cars, and measure nothing.
/// @param acs       normalised correspondences of the tilted camera
/// @param inliers   those that obey the pose, one flag each
/// @param T_2_1     motion of the tilted camera, |t| = 1
/// @param sigma     1σ of a point's position [-, normalised]
[[nodiscard]] std::optional<GroundScale> ground_scale(AcSpan acs, const std::vector<bool>& inliers,
                                                      const RelativePose& T_2_1,
                                                      const Eigen::Matrix3d& R_level_cam,
                                                      double sigma,
                                                      const GroundScaleOptions& options);

}  // namespace oneac
