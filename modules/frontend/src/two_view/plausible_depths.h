#pragma once

#include "oneac/features/correspondence.h"
#include "oneac/geometry/relative_pose.h"
#include "oneac/robust/motion_evidence.h"

#include <vector>

namespace oneac {

/// Inliers whose depth can be. A wrong match obeys the epipolar line of a pose that bends towards
/// it, and where it is long, or near the epipole, that takes little: one of 236 px among 380 of 3
/// px turned the direction by 3°. Not kept are, as far as the noise tells,
/// - points behind a camera,
/// - patches that come so near that they had to grow, and did not,
/// - points nearer to the camera than anything but the car itself, where the length is expected.
/// All are kept where more than three in ten would go: then it is the pose that is wrong.
/// @param pair      normalised
/// @param motion    of the vehicle as it is expected [camera heights]
/// @param focal_px  [px] of one normalised unit
[[nodiscard]] std::vector<bool> with_plausible_depths(const TrackedPair& pair,
                                                      const std::vector<bool>& inliers,
                                                      const RelativePose& pose,
                                                      const MotionPrior& motion, double focal_px);

}  // namespace oneac
