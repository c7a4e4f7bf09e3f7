#pragma once

#include "oneac/geometry/affine_correspondence.h"

#include <string>
#include <vector>

namespace oneac {

/// The second image of a pair with its correspondences.
struct Snapshot {
  int width = 0;                          ///< [px] of the image that acs refer to
  int height = 0;                         ///< [px]
  std::string jpeg;                       ///< of any size with the same sides' ratio
  std::vector<AffineCorrespondence> acs;  ///< [px]
  std::vector<bool> inlier;               ///< one per correspondence
};

/// An <svg> element to stand in an HtmlPage: the image, a line from x1 to x2 of each correspondence
/// and around x2 the parallelogram that A makes of a square of the first image; inliers and the
/// others in two colours. Correspondences that are not finite are left out.
/// @throws std::invalid_argument when there is not one flag per correspondence
[[nodiscard]] std::string snapshot_svg(const Snapshot& snapshot);

}  // namespace oneac
