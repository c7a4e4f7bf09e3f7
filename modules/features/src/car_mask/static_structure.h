#pragma once

#include "../image_pyramid.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace oneac::internal {

/// What the cells of an image have shown while the camera travelled.
enum class CellTrace : unsigned char {
  kNothing,  ///< no structure that could tell
  kRests,    ///< structure that stays where it is
  kMoves,    ///< structure that changes
};

/// A grid of square cells over a pyramid level.
struct CellGrid {
  int columns = 0;
  int rows = 0;
  int side = 1;  ///< [px of the level]
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  [[nodiscard]] std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};

/// Structure that survives the mean over time. Of each pixel the mean over the last frames of
/// g·r and of (g·r)² are kept, g the grey gradient and r the direction in which the scene flows
/// there: (mean g·r)² is all of mean (g·r)² where the structure rests and 1/frames of it where it
/// passes. Only g along r counts: lane lines and kerbs, which lie along r, look the same in every
/// frame although they move.
class StaticStructure {
 public:
  /// @param first_row  rows of the level above are not looked at
  void add(const PyramidLevel& level, const Eigen::Vector2d& foe, int first_row);
  /// One trace per cell. Before enough frames were added all are kNothing.
  [[nodiscard]] std::vector<CellTrace> traces(const CellGrid& grid) const;
  /// Frames in the mean.
  [[nodiscard]] int frames() const { return frames_; }
  /// Whether there are enough of them.
  [[nodiscard]] bool can_tell() const;
  void clear();

 private:
  struct Mean {
    float g = 0.0F;   ///< [grey/px]
    float gg = 0.0F;  ///< [grey²/px²]
  };
  [[nodiscard]] CellTrace trace(const CellGrid& grid, int column, int row) const;

  int width_ = 0;
  int height_ = 0;
  int frames_ = 0;
  std::vector<Mean> means_;
};

}  // namespace oneac::internal
