#pragma once

#include "bonnet.h"
#include "windscreen.h"

#include "oneac/simulation/simulation_options.h"

#include <vector>

namespace oneac::simulation {

/// What lies between the scene and the file: bonnet, rain, wiper, darkness, exposure, sensor.
class PictureEffects {
 public:
  explicit PictureEffects(const SimulationOptions& options);

  /// Changes grey levels as rendered; a pure function of its arguments.
  void apply(std::vector<float>& grey, double time_s, int side) const;
  [[nodiscard]] double noise() const;  ///< [grey levels] std. deviation that the sensor adds
  /// Factor of the exposure at a time; 1 without jumps.
  [[nodiscard]] double gain(double time_s) const;

 private:
  void darken(const Picture& picture, int side) const;

  SimulationOptions options_;
  Bonnet bonnet_;
  Windscreen windscreen_;
};

}  // namespace oneac::simulation
