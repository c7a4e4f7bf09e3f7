#pragma once

#include <deque>

namespace oneac {

/// Whether wheels are of one opinion on the scale of a map.
///
/// Wheels slip and spin, their counters freeze and jump: then they are wrong for as long as that
/// lasts, by anything, and every measurement looks as sure as the others. What they measure of a
/// map that is right is the same over and over; only that is believed.
class WheelConsensus {
 public:
  /// [m] over which measurements must agree: wheels do not spin evenly for so long.
  static constexpr double kWay = 20.0;

  struct Verdict {
    double median = 0.0;  ///< of the newest measurements
    bool fits = false;    ///< the newest is near it
    bool agreed = false;  ///< nearly all are, and they cover kWay
  };

  /// The vehicle went on by so much [m].
  void travel(double way) { way_ += way; }
  /// @param log_ratio  logarithm of true length over length in the map
  /// @param sigma      its 1σ
  [[nodiscard]] Verdict add(double log_ratio, double sigma);
  /// The map was multiplied: what was measured of it is now so much less.
  void rescale(double log_factor);
  void forget() { told_.clear(); }

 private:
  struct Told {
    double log_ratio, sigma, way;
  };
  [[nodiscard]] double median() const;

  std::deque<Told> told_;
  double way_ = 0.0;  ///< [m]
};

}  // namespace oneac
