#pragma once

#include "static_structure.h"

#include <vector>

namespace oneac::internal {

/// A cell as the growing sees it.
struct CellState {
  bool rests = false;    ///< structure that stays, by long evidence
  bool moves = false;    ///< structure that passes
  bool low = false;      ///< so far below the horizon that only the car can rest there
  bool distant = false;  ///< near the horizon or above it: far things rest there
};

/// Which cells belong to the car. Resting cells that hang together are one thing. It is the car's
/// when it has a low cell and does not reach up to the distant ones, as a vehicle ahead does. The
/// car ends at its upper outline: where this is long (a bonnet, not a speck), what lies below it
/// down to the border is car as well, unless most of what can be seen there passes: then only what
/// lies between the outline and the lowest rest of its columns is. One cell around is added.
/// @param cells  row by row, of `grid`
[[nodiscard]] std::vector<bool> car_region(const CellGrid& grid,
                                           const std::vector<CellState>& cells);

}  // namespace oneac::internal
