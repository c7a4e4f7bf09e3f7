#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <optional>

namespace oneac {

/// A reading of an inertial unit, in the vehicle frame.
struct InertialReading {
  double time_s = 0.0;
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  ///< specific force [m/s²]
  std::optional<double> yaw_rate;                          ///< about the vehicle's Z [rad/s]
};

/// Which way is down, out of the specific forces of a drive.
///
/// Ahead: the mean, in which speeding up and braking cancel but for the difference in speed between
/// the ends. Sideways: a_y = g_y + v ω, so the mean would lean into the turns; g_y is the value
/// that a straight line through (ω, a_y) has at ω = 0.
class GravityEstimator {
 public:
  void add(const InertialReading& reading);
  /// Specific force of a standing vehicle [m/s²]; empty before a few readings.
  [[nodiscard]] std::optional<Eigen::Vector3d> up() const;
  /// [rad] 1σ of the direction: what the speeds at the ends may differ by, over the time between.
  [[nodiscard]] double sigma() const;

 private:
  std::size_t count_ = 0;
  double first_s_ = 0.0, last_s_ = 0.0;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  std::size_t turning_count_ = 0;  ///< readings that have a yaw rate; of them the sums ...
  double sum_w_ = 0.0, sum_ww_ = 0.0, sum_y_ = 0.0, sum_wy_ = 0.0;
};

}  // namespace oneac
