#pragma once

#include "oneac/evaluation/trajectory_io.h"
#include "oneac/geometry/affine_correspondence.h"
#include "oneac/geometry/relative_pose.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
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

/// The motion of a pair as the reference has it; empty beyond its end.
[[nodiscard]] std::optional<RelativePose> true_motion(const LogPair& pair, const Trajectory& truth);

}  // namespace oneac
