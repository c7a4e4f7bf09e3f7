#pragma once

#include "two_view.h"

#include "oneac/features/correspondence.h"
#include "oneac/robust/motion_evidence.h"

#include <Eigen/Core>

#include <vector>

namespace oneac {

/// [camera heights] A car whose steps are shorter creeps: even the near road moves by a few pixels.
constexpr double kCreeping = 0.15;

/// Whether a car of which this is expected creeps or stands: then clouds drift through the image as
/// fast as what is near.
[[nodiscard]] bool creeps(const MotionPrior& expected);

/// The correspondences that cannot be clouds, by their ray in the first view: not above the
/// horizon. Empty when too few are left to measure by.
/// @param R_level_cam  of the first view
[[nodiscard]] std::vector<bool> below_the_sky(const TrackedPair& pair,
                                              const Eigen::Matrix3d& R_level_cam);

/// The others' part in the result: inliers are those of them that agree with the motion found, as
/// trees and houses do and clouds do not.
[[nodiscard]] TwoView with_the_sky(TwoView seen, const std::vector<bool>& told,
                                   double threshold_px);

}  // namespace oneac
