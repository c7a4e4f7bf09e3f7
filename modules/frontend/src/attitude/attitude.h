#pragma once

#include "gravity_estimator.h"
#include "levelling.h"
#include "two_view/two_view.h"

#include "oneac/frontend/frame_result.h"
#include "oneac/frontend/suspension_tilt.h"
#include "oneac/frontend/tilt_estimator.h"

#include <Eigen/Core>

#include <optional>
#include <string>

namespace oneac {

/// How the camera leans: what was given, what the drive tells of the mounting, and what the springs
/// add. The one owner of TiltEstimator, SuspensionTilt and GravityEstimator.
class Attitude {
 public:
  explicit Attitude(const TiltOptions& options);

  /// The first frame, with the camera's sensor pose.
  void start(const Eigen::Matrix3d& R_vehicle_cam);
  /// For the tilt source "imu"; may come before the first frame.
  void add_inertial(const InertialReading& reading);
  /// The first step that moves shows how the camera leans before its length is asked of the road: a
  /// pitch that nobody told is often degrees off. follow() does not count its direction again.
  void see(const TwoView& seen);
  /// The plane of a road in view shows the camera's roll to the right against it [rad].
  void see_road(const AngleBelief& roll_right);
  /// Learns from a step, which ends at the newest frame from then on.
  void follow(const StepResult& step);

  /// Of the camera on the level vehicle, as believed now; zero before the first frame.
  [[nodiscard]] TiltBelief mounting() const;
  /// [rad] pitch up that the springs add in the newest frame, against the road.
  [[nodiscard]] AngleBelief suspension() const;
  /// Of the newest frame, pitch on the springs included. The roll is the mounting's: that of the
  /// springs is felt by its effect on the pitch only.
  [[nodiscard]] Levelling now() const;
  /// The same of an earlier view, from which the camera turned by this.
  [[nodiscard]] Levelling before(const Eigen::Matrix3d& R_now_before) const;

 private:
  /// TiltOptions::source, resolved once.
  enum class Source { kLog, kParams, kImu, kDrive };

  [[nodiscard]] static Source source_of(const std::string& name);
  [[nodiscard]] Tilt given() const;
  /// A log whose camera is exactly level says nothing of its mount.
  [[nodiscard]] bool is_told() const;
  [[nodiscard]] Levelling levelling(double pitch_up) const;

  TiltOptions options_;
  Source source_;
  Eigen::Matrix3d R_vehicle_cam_ = Eigen::Matrix3d::Identity();
  GravityEstimator gravity_;
  std::optional<TiltEstimator> mounting_;  ///< from the first frame on
  std::optional<SuspensionTilt> road_;     ///< from the first frame on
  bool has_seen_ = false;                  ///< a step that moves
  bool has_begun_ = false;                 ///< with the step that follow() is told next
};

}  // namespace oneac
