#pragma once

#include "oneac/frontend/window_options.h"

namespace oneac {

/// Kalman filter of the logarithm of (true length / length in the map).
///
/// The map is kept in metres: a correction is applied to the map at once, so the state is zero and
/// only its variance remains. The local map carries the scale from keyframe to keyframe with a
/// random walk; the road, or a speed, measures it.
class ScaleFilter {
 public:
  explicit ScaleFilter(const ScaleOptions& options) : options_(options) {}

  /// A keyframe more: the scale may have drifted.
  /// @return  how far what is measured from now on speaks for the scale before: the regression of
  ///          the old state on the new one, P / (P + Q); 1 while nothing is known
  double drift();
  /// The map lost its scale (nothing was carried over); the next measurement sets it.
  void lose();
  /// A measurement of true length over map length, with its relative 1σ.
  /// @return the factor by which the map's lengths must be multiplied; 1 for what is not believed
  [[nodiscard]] double correct(double ratio, double sigma);

  /// Relative 1σ of the map's scale; infinite before the first measurement.
  [[nodiscard]] double uncertainty() const;
  [[nodiscard]] bool is_metric() const { return uncertainty() <= options_.max_uncertainty; }

 private:
  ScaleOptions options_;
  bool known_ = false;
  double variance_ = 0.0;
  int refused_ = 0;
};

}  // namespace oneac
