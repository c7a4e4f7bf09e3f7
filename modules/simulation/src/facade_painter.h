#pragma once

#include "street_layout.h"
#include "texture.h"

#include <cstdint>

namespace oneac::simulation {

/// The walls of a building: bricks or plaster, stains, rows of windows with panes, doors, posters.
/// Wide as the longer side, high as the box; the top row is the roof's edge. No two are alike.
[[nodiscard]] Texture paint_facade(const Box& box, std::uint64_t seed);

/// The sides of a truck or bus: panels, lettering, dirt.
[[nodiscard]] Texture paint_truck(const Box& box, std::uint64_t seed);

/// The sides of a thing at the kerb: body, glass, trim, stickers and dirt.
[[nodiscard]] Texture paint_obstacle(const Box& box, std::uint64_t seed);

}  // namespace oneac::simulation
