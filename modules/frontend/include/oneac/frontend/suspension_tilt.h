#pragma once

#include "oneac/frontend/tilt_belief.h"

#include <Eigen/Core>

#include <optional>

namespace oneac {

/// What one step of the camera says about its tilt against the road.
struct TiltStep {
  /// Where the camera went, in its newest view, unit length; either way along it.
  struct Travel {
    Eigen::Vector3d direction;
    double sigma = 0.0;  ///< [rad] 1σ of the way's elevation against the road
    /// [rad²] of the direction, as the images tell it; zero: not known
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  };

  Eigen::Matrix3d R_2_1 = Eigen::Matrix3d::Identity();
  double seconds = 0.0;
  double length = 0.0;           ///< [m] driven
  std::optional<Travel> travel;  ///< empty when the images do not tell
};

/// Pitch and roll of the camera against its road, frame by frame: the mounting, and what the
/// springs add when the car brakes, speeds up, rolls over bumps or leans in a bend.
///
/// Extended Kalman filter over the road's normal in the camera. The images' rotation turns it, the
/// road's slope and cross fall change a little on the way. Measured by the direction of travel,
/// which lies in the road, and held by the mounting as far as a body on springs keeps it. A
/// pitch alone would take the yaw of a leaning car for pitching: 1° of lean in a bend of 90° adds
/// up to 1.6°.
class SuspensionTilt {
 public:
  /// @param mounting  tilt of the camera on the level vehicle
  explicit SuspensionTilt(const TiltBelief& mounting);

  /// The way that leads on from the newest frame, before anything was driven.
  void begin(const TiltStep::Travel& travel, const TiltBelief& mounting);
  /// @param mounting  as believed now
  void add_step(const TiltStep& step, const TiltBelief& mounting);
  /// A step that the images did not tell about: the springs are at rest again, more or less.
  void lose(const TiltBelief& mounting);

  /// Against the road, at the newest frame.
  [[nodiscard]] TiltBelief tilt() const;
  /// The same at an earlier view, from which the camera turned by this.
  [[nodiscard]] Tilt tilt_before(const Eigen::Matrix3d& R_now_before) const;

 private:
  void turn(const TiltStep& step);
  /// @param seconds  since the measurement before
  void measure_travel(const TiltStep::Travel& travel, double seconds, const TiltBelief& mounting);
  void hold(double seconds, const TiltBelief& mounting);
  void measure(const Eigen::Vector2d& row, double off, double sigma);

  Tilt tilt_;
  Eigen::Matrix2d covariance_ = Eigen::Matrix2d::Zero();  ///< [rad²] of pitch and roll
};

}  // namespace oneac
