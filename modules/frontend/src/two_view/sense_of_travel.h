#pragma once

#include "two_view.h"

#include <Eigen/Core>

namespace oneac {

/// Forwards or backwards: t and −t explain the same epipolar lines, and points before both cameras
/// tell them apart by their parallax. Far ones have next to none, and each of them votes at random.
/// Where the votes are no surer than that (3 σ of a fair coin) the vehicle goes on as before.
/// @param heading  t̂ of the step before; zero: unknown
[[nodiscard]] TwoView in_lasting_sense(TwoView found, const Eigen::Vector3d& heading);

}  // namespace oneac
