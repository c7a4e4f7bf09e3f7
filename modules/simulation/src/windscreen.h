#pragma once

#include "picture.h"

#include "oneac/simulation/simulation_options.h"

#include <cstdint>
#include <optional>

namespace oneac::simulation {

/// Rain on the glass before the camera: drops that fall where the wiper has passed, show the scene
/// upside down and stay until it passes again; drops out of its reach, which stay long; the blade.
/// A pure function of time; the two cameras of a pair look through different drops.
class Windscreen {
 public:
  explicit Windscreen(const SimulationOptions& options);

  void draw(const Picture& picture, double time_s, int side) const;

 private:
  struct Drop {
    double u;
    double v;
    double radius;  ///< [px]
  };

  void fade(const Picture& picture) const;
  void draw_drops(const Picture& picture, double time_s, int side) const;
  void draw_blade(const Picture& picture, double time_s) const;
  [[nodiscard]] std::optional<Drop> swept_drop(int k, double time_s, int side) const;
  [[nodiscard]] std::optional<Drop> lasting_drop(int k, double time_s, int side) const;

  int width_;
  int height_;
  bool rain_;
  bool wiper_;
  std::uint64_t seed_;
};

}  // namespace oneac::simulation
