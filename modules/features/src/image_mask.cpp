#include "oneac/features/image_mask.h"

#include "oneac/base/mask.h"

#include <cmath>

namespace oneac {

bool usable_in(const GreyImage& mask, const Eigen::Vector2d& u) {
  if (mask.empty()) return true;
  const auto column = static_cast<int>(std::lround(u.x()));
  const auto row = static_cast<int>(std::lround(u.y()));
  if (column < 0 || row < 0 || column >= mask.width() || row >= mask.height()) return false;
  return mask.row(row)[column] >= kMaskUses;
}

}  // namespace oneac
