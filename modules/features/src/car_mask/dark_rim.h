#pragma once

#include "patch/image_pyramid.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace oneac::internal {

/// Learns what a lens leaves black around its picture (a fisheye's circle, the corners of a tube):
/// what has been dark, and the same, in every frame that shows travel, and reaches the border. Its
/// edge gives corners that rest, and above the horizon those pass for far points.
///
/// What has ever shown something is the scene. A sky that stays black all night is taken for rim,
/// which loses nothing that could be measured.
class DarkRim {
 public:
  /// Takes a frame that shows travel. @pre all of one size
  /// @return whether it was decided anew what the rim is
  bool add(const PyramidLevel& level);
  [[nodiscard]] bool any() const { return any_; }
  /// Whether this place is the rim, or so near that a patch would reach over its edge. [px of the
  /// level]
  [[nodiscard]] bool covers(const Eigen::Vector2d& u) const;

 private:
  void decide();
  [[nodiscard]] bool is_constant(std::size_t i) const;

  int width_ = 0;
  int height_ = 0;
  int frames_ = 0;
  bool over_ = false;  ///< nothing is dark and the same any more
  bool any_ = false;
  std::vector<std::uint16_t> darkest_, brightest_;
  std::vector<bool> rim_;
};

}  // namespace oneac::internal
