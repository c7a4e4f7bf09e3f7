#pragma once

#include <mrpt/maps/CSimpleMap.h>

#include <cstddef>

namespace oneac::compat {
namespace detail {

template <class Map>
auto keyframe_of(const Map& map, std::size_t index, int) -> decltype(map.getAsPair(index)) {
  return map.getAsPair(index);
}

template <class Map>
auto keyframe_of(const Map& map, std::size_t index, long) {
  return map.get(index);
}

}  // namespace detail

/// A keyframe of a map: pointers `pose` and `sf` (its observations). MRPT 2.5 has getAsPair() for
/// it, later versions get().
inline auto keyframe_of(const mrpt::maps::CSimpleMap& map, std::size_t index) {
  return detail::keyframe_of(map, index, 0);
}

}  // namespace oneac::compat
