#pragma once

#include "route.h"

#include <Eigen/Core>

namespace oneac::simulation {

/// Adds up the way of a vehicle by the teeth of a ring that turns with its wheels.
class WheelCounter {
 public:
  /// @param size  the wheel's, as believed, over the true one
  explicit WheelCounter(double size) : size_(size) {}

  /// The vehicle is `seconds` later; the first call says where it starts.
  void add(const PlanarState& now, double seconds);
  [[nodiscard]] double heading() const { return last_.heading; }
  /// [m] from the start, in axes with this heading.
  [[nodiscard]] Eigen::Vector2d position(double heading) const;

 private:
  double size_;
  bool started_ = false;
  PlanarState last_;
  double way_ = 0.0;      ///< [m] by the wheels
  double counted_ = 0.0;  ///< [m] of it in whole teeth
  Eigen::Vector2d position_ = Eigen::Vector2d::Zero();
};

}  // namespace oneac::simulation
