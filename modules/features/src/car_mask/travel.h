#pragma once

#include "patch/image_pyramid.h"

#include <Eigen/Core>

namespace oneac::internal {

/// Whether two images of a sequence certainly show the camera travelling along its axis, told by
/// the pixels alone: what lies above the road's near part flows away from the direction of travel,
/// left and right of it, once the common shift (yaw and pitch) is taken out. Backwards it flows
/// towards it. Traffic before a standing car passes to one side, or comes on one and leaves on the
/// other; a standing car among it does not travel by this.
/// @param foe         place of the direction of travel [px of the levels]
/// @param end_row     rows from here on are not asked: the car itself may be there
/// @pre both levels have the same size
[[nodiscard]] bool shows_travel(const PyramidLevel& before, const PyramidLevel& now,
                                const Eigen::Vector2d& foe, int end_row);

}  // namespace oneac::internal
