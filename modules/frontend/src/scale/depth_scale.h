#pragma once

#include "measurements.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace oneac {

/// The map's scale by depths that stereo measured; empty with fewer than `least` that agree.
[[nodiscard]] std::optional<ScaleMeasurement> scale_by_depths(
    const std::vector<DepthComparison>& depths, std::size_t least);

}  // namespace oneac
