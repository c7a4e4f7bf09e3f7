#pragma once

#include "../image_pyramid.h"

#include <Eigen/Core>

namespace oneac::internal {

/// A camera at the scale of a pyramid level, and which way it travels.
struct TravelView {
  Eigen::Vector2d centre{0.0, 0.0};  ///< principal point [px of the level]
  Eigen::Vector2d foe{0.0, 0.0};     ///< place of the direction of travel [px of the level]
  double focal = 1.0;                ///< [px of the level]
  int end_row = 0;  ///< rows from here on are not asked: the car itself may be there
};

/// A pyramid level smoothed by the binomial 3×3 kernel once more: flows by slopes of finer
/// structure than that scatter with the size of the flow, and a pitch on the springs is large.
[[nodiscard]] PyramidLevel smoothed_for_travel(const PyramidLevel& level);

/// What two images show of the camera's motion.
struct Travel {
  bool shown = false;
  double yaw = 0.0;  ///< [rad] to the right, where the images tell
};

/// Whether two images of a sequence certainly show the camera travelling along its axis, told by
/// the pixels alone: what lies above the road's near part flows away from the direction of travel,
/// left and right of it, once the common rotation is taken out. Backwards it flows towards it.
/// Traffic before a standing car passes to one side, or comes on one and leaves on the other; a
/// standing car among it does not travel by this.
/// @param before, now  smoothed_for_travel(), of the same size
[[nodiscard]] Travel shows_travel(const PyramidLevel& before, const PyramidLevel& now,
                                  const TravelView& view);

}  // namespace oneac::internal
