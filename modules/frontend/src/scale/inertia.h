#pragma once

#include "oneac/frontend/window_options.h"

#include <deque>
#include <optional>

namespace oneac {

/// What a step's length may be by the speed before it.
struct ExpectedLength {
  double length = 0.0;  ///< [m]
  double sigma = 0.0;   ///< [m] 1σ
  double least = 0.0;   ///< [m] nothing shorter is possible for a vehicle ...
  double most = 0.0;    ///< [m] ... and nothing longer
  double common = 0.0;  ///< [m] 1σ that lengths of steps around it share

  /// Whether a length [m] with this 1σ [m] can be true.
  [[nodiscard]] bool allows(double length_m, double sigma_m) const;
};

/// How long a step took. Stamps are often taken where an image arrives, which jitters by half an
/// interval on a busy computer, while the shutter is regular; both are possible.
struct StepTime {
  double mean = 0.0;        ///< [s] between the two
  double half_range = 0.0;  ///< [s] by which either differs from the mean

  [[nodiscard]] double least() const { return mean - half_range; }
  [[nodiscard]] double most() const { return mean + half_range; }
};

/// The interval of a camera's shutter, learned as the median of its newest stamps' differences.
class ShutterClock {
 public:
  /// Stamps of two images in a row were so far apart [s].
  void tell(double seconds);
  /// What lies between two stamps: their difference, or a whole number of intervals near it.
  [[nodiscard]] StepTime between(double seconds) const;

 private:
  std::deque<double> newest_;  ///< [s]
  double interval_ = 0.0;      ///< [s]; 0: not known yet
};

/// A vehicle has mass: what it did a moment ago bounds what it does now. Kalman filter of the speed
/// under accelerations of `scale.acceleration` (1σ), and the physical bound
/// `scale.max_acceleration`, which tyres do not exceed.
class Inertia {
 public:
  /// @param memory_s  a speed older than this says nothing
  Inertia(const ScaleOptions& options, double memory_s);

  /// Of the step between two times [s]; empty while no speed is known.
  [[nodiscard]] std::optional<ExpectedLength> expect(double begin_s, double end_s) const;
  /// A step was this long, 1σ, both [m].
  /// @param common  [-] relative 1σ that this length shares with those around it, as the map's
  /// scale: it does not average out
  void tell(double begin_s, double end_s, double length, double sigma, double common = 0.0);
  /// An image was taken at the end of this step, whatever is known of its length.
  void tick(double begin_s, double end_s) { clock_.tell(end_s - begin_s); }
  void forget() { known_ = false; }

 private:
  ShutterClock clock_;
  double acceleration_, max_acceleration_;
  double shared_;  ///< [-] 1σ that all lengths have in common
  double memory_s_;
  bool known_ = false;
  double speed_ = 0.0;   ///< [m/s]
  double sigma_ = 0.0;   ///< [m/s] 1σ, without what steps share
  double common_ = 0.0;  ///< [-] relative 1σ that the newest step shares with others
  double time_s_ = 0.0;  ///< [s] to which it belongs: the middle of the newest step
};

}  // namespace oneac
