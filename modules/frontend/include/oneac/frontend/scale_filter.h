#pragma once

#include "oneac/frontend/wheel_consensus.h"
#include "oneac/frontend/window_options.h"

namespace oneac {

/// Kalman filter of the logarithm of (true length / length in the map).
///
/// The map is kept in metres: a correction is applied to the map at once, so the state is zero and
/// only its variance remains. The local map carries the scale from keyframe to keyframe with a
/// random walk; the road, or a speed, measures it. What is wrong with the road's measurement (its
/// bumps, the height on the springs) stays the same while the same road is in view: a second state,
/// so that ten keyframes on one bump do not count as ten measurements. With wheels that state is
/// the size of the tyres, which stays for the drive, and the map's scale is never surer than it.
///
/// With the source "wheels" there is no scale before a WheelConsensus, and where one that is there
/// contradicts the map, or none is, the scale is not metric: one of the two is wrong, and nothing
/// says which. The map is not moved then, until they agree again.
class ScaleFilter {
 public:
  /// [steps] that share a landmark: what is wrong with its depth is wrong in all of them, so that
  /// their variances add up so many times over.
  static constexpr double kStepsOfALandmark = 16.0;

  /// @pre options.validate() passes
  explicit ScaleFilter(const ScaleOptions& options);

  /// A keyframe more: the scale may have drifted.
  /// @param way               [m] driven since the last one
  /// @param carried_variance  relative, of the lengths that landmarks carried since then
  /// @param turn              [rad] since the last one
  /// @return  how far what is measured from now on speaks for the scale before: the regression of
  ///          the old state on the new one, P / (P + Q); 1 while nothing is known
  double drift(double way, double carried_variance, double turn = 0.0);
  /// The map lost its scale (nothing was carried over); the next measurement sets it.
  void lose();
  /// A measurement of true length over map length, with its relative 1σ.
  /// @param sigma  of this measurement alone, without the road's lasting error
  /// @return the factor by which the map's lengths must be multiplied; 1 for what is not believed
  [[nodiscard]] double correct(double ratio, double sigma);

  /// Whether the last correct() gave up what was believed before, and began with its measurement.
  [[nodiscard]] bool began_anew() const { return began_anew_; }

  /// Relative 1σ of the map's scale; infinite before the first measurement.
  [[nodiscard]] double uncertainty() const;
  /// 1σ is below ScaleOptions::max_uncertainty, and wheels do not contradict it.
  [[nodiscard]] bool is_metric() const {
    return !doubted_ && uncertainty() <= options_.max_uncertainty;
  }

 private:
  double start(double ratio, double noise);
  /// A measurement that is believed. @param innovation  of it against the state, without the error
  double update(double innovation, double noise);
  double correct_by_wheels(double log_ratio, double sigma);
  [[nodiscard]] bool is_likely(double innovation, double noise) const;
  [[nodiscard]] double surprise(double innovation, double noise) const;
  [[nodiscard]] double variance_of_innovation(double noise) const;

  ScaleOptions options_;
  double lasting_variance_;  ///< of the error that the road's, or the wheels', measurements share
  double variance_ = 0.0;    ///< of the state
  double error_ = 0.0;       ///< that the road's measurements share now, ...
  double error_variance_ = 0.0;  ///< ... its variance ...
  double covariance_ = 0.0;      ///< ... and its covariance with the state
  double refused_way_ = 0.0;     ///< [m] since the first of those refused
  WheelConsensus wheels_;
  int refused_ = 0;  ///< in a row
  bool by_wheels_;
  bool known_ = false;
  bool began_anew_ = false;
  bool doubted_ = false;  ///< wheels are not of one opinion, or of another one
};

}  // namespace oneac
