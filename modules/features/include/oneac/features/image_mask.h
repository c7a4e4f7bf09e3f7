#pragma once

#include "oneac/base/image.h"

#include <Eigen/Core>

namespace oneac {

/// Whether a mask of the image leaves the pixel nearest to u [px] in use: it is inside and not dark
/// (below 128). Of an empty mask all are.
[[nodiscard]] bool usable_in(const GreyImage& mask, const Eigen::Vector2d& u);

}  // namespace oneac
