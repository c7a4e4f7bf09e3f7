#pragma once

#include "canvas.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace oneac::simulation {

/// The patch of a surface that one pixel sees: centre and the images of one step to the right and
/// one step down, in metres on the surface.
struct Footprint {
  Eigen::Vector2f centre;
  Eigen::Vector2f right;
  Eigen::Vector2f down;
};

/// A painted surface that can be looked at from any distance and slant without aliasing: a pyramid
/// of halved images, read trilinearly at several taps along the longer axis of the footprint.
/// Repeats in both directions.
class Texture {
 public:
  /// Values are rounded to 8 bits. @param texel_m  side of a texel [m]
  Texture(const Canvas& canvas, double texel_m);

  /// Mean over the footprint [grey levels].
  [[nodiscard]] float sample(const Footprint& footprint) const;
  [[nodiscard]] double width_m() const { return levels_.front().width * texel_m_; }
  [[nodiscard]] double height_m() const { return levels_.front().height * texel_m_; }

 private:
  struct Level {
    int width;
    int height;
    float u_scale;  ///< texels of this level per texel of the finest
    float v_scale;
    std::vector<std::uint8_t> texels;

    /// At a position in texels of the finest level.
    [[nodiscard]] float bilinear(const Eigen::Vector2f& position) const;
  };
  struct Taps;

  [[nodiscard]] static Level halved(const Level& fine);
  [[nodiscard]] Taps taps(const Footprint& footprint) const;
  [[nodiscard]] static float mean(const Level& level, const Taps& taps);

  double texel_m_;
  float texels_per_m_;
  std::vector<Level> levels_;
};

}  // namespace oneac::simulation
