#pragma once

#include "measurements.h"
#include "two_view/two_view.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>

namespace oneac {

/// How far the camera went along a direction, by the points of the pair whose depths the right
/// image measured: near ones know it, standing or moving. Robust against what has a motion of its
/// own.
/// @param heading  t̂ of a camera that goes on as it did, for a step without direction
/// @param least    points that must agree; with fewer the result is empty
[[nodiscard]] std::optional<MeasuredTravel> stereo_travel(const TwoView& seen,
                                                          const Eigen::Vector3d& heading,
                                                          std::size_t least);

}  // namespace oneac
