#pragma once

#include "route.h"
#include "texture.h"

#include <cstdint>

namespace oneac::simulation {

/// Markings and repairs are stored around this value, to be added to the asphalt.
inline constexpr double kNeutral = 128.0;

/// What is special to one street: its rectangle in the leg's frame, painted along x and y.
struct RoadDecal {
  Eigen::Vector2d low;  ///< corner in the leg's frame [m]
  Eigen::Vector2d high;
  Texture texture;  ///< u along x, v along y, from `low`; differences from kNeutral
};

/// How much of the road's structure is to be seen.
struct RoadLook {
  float tone;        ///< of the asphalt [grey levels]
  double structure;  ///< contrast of asphalt and markings against the textured road's [-]
  double paint;      ///< the same of the markings
  bool grain;        ///< stones, cracks, speckle
  bool details;      ///< paving, repairs, zebra crossings
  bool slabs;        ///< the whole road is paved, each slab as the other
  bool wet;          ///< it mirrors
};
[[nodiscard]] RoadLook road_look(RoadSurface road);

/// Asphalt: stones, speckle, stains and cracks of all sizes; 25.6 m before it repeats.
[[nodiscard]] Texture paint_asphalt(const RoadLook& look, std::uint64_t seed);
/// Slow changes of tone, 37 m before they repeat: laid askew over the asphalt, so that no two
/// places of the road look alike.
[[nodiscard]] Texture paint_road_tone(const RoadLook& look, std::uint64_t seed);
/// How much of the light that falls on the road its water may mirror, from 0 to 255.
[[nodiscard]] Texture paint_puddles(std::uint64_t seed);
/// Lines, zebra crossing, patches, manholes, cracks, paving slabs of one street.
[[nodiscard]] RoadDecal paint_decal(const RoadLook& look, const Leg& leg, std::uint64_t seed);

}  // namespace oneac::simulation
