#pragma once

#include "texture.h"

#include <cstdint>

namespace oneac::simulation {

/// The underside of a closed cover of clouds, seen from below; 12 km before it repeats.
[[nodiscard]] Texture paint_clouds(std::uint64_t seed);

}  // namespace oneac::simulation
