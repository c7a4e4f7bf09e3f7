#pragma once

#include "oneac/geometry/affine_correspondence.h"

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

namespace oneac {

/// Two successive images of a drive.
struct LogPair {
  std::size_t index1, index2;             ///< images of the camera in the log
  std::vector<AffineCorrespondence> acs;  ///< normalised
  Eigen::Matrix3d R_level_cam;            ///< of the log's tilt
  double focal_px;
};

/// Correspondences of every K-th image with the one before.
/// @param features  name of the extractor. A tracker is told the motion of the pair before, as the
///                  one-AC consensus sees it: without length, as in a drive that has no scale.
/// @throws InputError for a log that cannot be read
[[nodiscard]] std::vector<LogPair> pairs_of_log(const std::string& log, std::size_t every,
                                                const std::string& features);

}  // namespace oneac
