#pragma once

#include "two_view.h"

namespace oneac {

/// The same two views with the motion that depths of near points tell, where the camera creeps or
/// stands: then epipolar geometry follows what moves at the far end of the street, while near
/// points of known depth tell rotation and translation each for itself.
///
/// 3-D–2-D: robust least squares over (R, t) of the points of the second view, by their depths, as
/// seen in the first; points without a depth lie far away and tell the rotation. A translation that
/// is not beyond its noise is a rest. Unchanged where the car does not creep, where fewer than half
/// of the points agree on one motion, where too few of those know their depths, and where wheels do
/// not allow that motion: it is that of a bus then.
/// @param depths        [m] in the second view; a step is short enough for those of the first to do
/// @param prior         the level, which tells what cannot be clouds, and the car's course
/// @param threshold_px  of an inlier
[[nodiscard]] TwoView creeping_by_depths(TwoView seen, const PointDepths& depths,
                                         const TwoViewPrior& prior, double threshold_px);

}  // namespace oneac
