#pragma once

#include "canvas.h"
#include "picture.h"

#include "oneac/simulation/simulation_options.h"

namespace oneac::simulation {

/// The vehicle's own bonnet at the lower edge of the picture: paint with seams, nozzles, dust and
/// dried drops, which do not move, and what it reflects of the scene, which moves the wrong way.
class Bonnet {
 public:
  explicit Bonnet(const SimulationOptions& options);

  /// Draws over a picture. @param side  1: seen by the right camera of a pair
  void draw(const Picture& picture, int side) const;

 private:
  [[nodiscard]] double edge(double u) const;  ///< row of its edge
  [[nodiscard]] float surface(const Picture& picture, double u, double v) const;

  int width_;
  int height_;
  double share_;
  double disparity_px_;
  Canvas marks_;  ///< differences from the paint
};

}  // namespace oneac::simulation
