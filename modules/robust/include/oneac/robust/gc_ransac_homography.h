#pragma once

#include "oneac/robust/gc_ransac.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace oneac {

enum class HomographyMethod { k4pc, k2ac };

/// The homography that most correspondences obey.
struct RobustHomography {
  bool found = false;                               ///< at least min_inliers obey H
  Eigen::Matrix3d H = Eigen::Matrix3d::Identity();  ///< x2 ~ H x1, scaled as homography_4pc
  std::vector<bool> inliers;                        ///< one per correspondence
  std::size_t inlier_count = 0;
  double cost = 0.0;  ///< MSAC cost on the transfer error, 0 … number of correspondences
  RobustStatistics statistics;
};

/// Homography by Graph-Cut RANSAC; the machinery of gc_ransac with the transfer error |x2 − H(x1)|.
/// Refits are in least squares with the method's own equations (points, or points and affinities).
/// @param threshold  [-] normalised image units; options.threshold_px and lo_model are not looked
/// at
/// @throws std::invalid_argument for options or a threshold out of bounds
[[nodiscard]] RobustHomography fit_homography(AcSpan acs, double threshold, HomographyMethod method,
                                              std::uint64_t seed, const GcRansacOptions& options);

}  // namespace oneac
