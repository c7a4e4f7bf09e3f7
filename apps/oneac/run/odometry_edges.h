#pragma once

#include "drive_record.h"

#include "oneac/frontend/keyframe.h"

#include <Eigen/Core>

#include <vector>

namespace oneac::app {

/// What the errors of the steps from one keyframe to the next add up to, as LoopKeyframe has it;
/// zero over a loss of tracking.
[[nodiscard]] Eigen::Matrix<double, 6, 6> covariance_between(const Keyframe& before,
                                                             const Keyframe& keyframe,
                                                             const DriveRecord& record);

/// The keyframes without points, each edge as uncertain as its steps are together. The window's own
/// information is that of a keyframe whose landmarks are known: it adds up to a fraction of the
/// drift, and would have a back-end refuse true loops.
[[nodiscard]] std::vector<Keyframe> keyframes_by_steps(const DriveRecord& record);

}  // namespace oneac::app
