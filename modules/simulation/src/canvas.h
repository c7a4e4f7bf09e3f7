#pragma once

#include "random_numbers.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace oneac::simulation {

/// A surface to paint on, in texels; coordinates may run over the borders and wrap around. Every
/// edge is drawn with the share of the texel that it covers.
class Canvas {
 public:
  Canvas(int width, int height, float value);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] float at(int u, int v) const { return values_[index(u, v)]; }

  /// An axis-parallel rectangle [u0, u1) x [v0, v1), mixed in with the given opacity.
  void rectangle(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double value,
                 double opacity = 1.0);
  struct Ellipse {
    Eigen::Vector2d centre;
    Eigen::Vector2d radii;
    double angle;
  };
  void ellipse(const Ellipse& shape, double value, double opacity = 1.0);
  /// A thin wandering line (a crack) of the given number of segments.
  void crack(RandomNumbers& random, int segments, double width, double value);

  struct Leaves {
    double smallest;  ///< radius [texels]
    double largest;   ///< radius [texels]
    double coverage;  ///< share of the area painted per octave of radius
    double contrast;  ///< std. deviation of the tones
    double angular;   ///< share of rectangles among ellipses
  };
  /// Overlapping blobs of all sizes, coarse first ("dead leaves"): each octave covers the same
  /// area, which gives the scale-free statistics of natural images and structure at every distance.
  void dead_leaves(RandomNumbers& random, const Leaves& leaves);
  /// Independent noise per texel.
  void grain(RandomNumbers& random, double sigma);

 private:
  [[nodiscard]] std::size_t index(int u, int v) const;
  void mix(int u, int v, float value, float opacity);

  int width_;
  int height_;
  std::vector<float> values_;
};

}  // namespace oneac::simulation
