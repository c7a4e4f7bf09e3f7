#pragma once

#include "oneac/frontend/front_end_options.h"
#include "oneac/frontend/tilt_belief.h"
#include "oneac/geometry/relative_pose.h"

#include <Eigen/Core>

#include <deque>

namespace oneac {

/// The rotation that levels the camera: a given tilt, corrected by the drive.
///
/// Pitch: a vehicle travels along its road, so in a levelled camera the translation has no vertical
/// part; the median of its elevation over the recent steps is the error of the given pitch, which
/// is worth some steps of driving, and less the more the drive contradicts it. Roll: a vehicle
/// turns about its upright, so over a bend the rotation of a levelled camera has no part about its
/// axis; least squares of the roll's share against the yaw's, held by the given roll, over a longer
/// past, since bends are rare. What the springs pitch is its noise, taken from the drive. The
/// road's own plane shows the roll, too, on straight ways as well, as far as it is not itself
/// inclined. With source "drive" there is nothing given: the first steps set the pitch.
class TiltEstimator {
 public:
  /// @param given  [rad] to start from; with source "drive" only a place to look near
  /// @param told   somebody stated it; else it is what a log reads that says nothing
  TiltEstimator(const Tilt& given, const TiltOptions& options, bool told = true);

  /// Replaces what is given, e.g. by a longer mean of the accelerometer.
  void set_given(const Tilt& given);
  /// Learns from a motion of the (tilted) camera. Steps that are not mainly forward say nothing
  /// about pitch, nor do those whose direction the images hardly know: before far scenery it
  /// follows what little else moves, all the same way.
  /// @param elevation_sigma  [rad] 1σ of the direction's elevation by the images; 0: not known
  void add_step(const RelativePose& T_2_1, double elevation_sigma = 0.0);
  /// Learns from the plane of the road in view: roll to the right of the camera against it [rad].
  void see_road(const AngleBelief& roll_right);

  /// [rad] as believed now.
  [[nodiscard]] const Tilt& tilt() const { return belief_.tilt; }
  [[nodiscard]] const TiltBelief& belief() const { return belief_; }
  /// R_level_cam of the present tilt.
  [[nodiscard]] Eigen::Matrix3d levelling() const { return levelling_rotation(belief_.tilt); }

 private:
  void update();
  [[nodiscard]] double pitch_correction(double& sigma) const;
  [[nodiscard]] double worth_of_given(double off) const;
  [[nodiscard]] double given_roll_sigma() const;
  /// Of the given roll, by the road's plane; none seen: σ is infinite.
  [[nodiscard]] AngleBelief roll_off_by_road() const;
  [[nodiscard]] double roll_correction(double& sigma) const;

  Tilt given_;
  bool told_;
  TiltOptions options_;
  bool unknown_;                         ///< source "drive": nothing is given
  std::deque<Eigen::Vector3d> travels_;  ///< unit, forward, in the camera
  std::deque<Eigen::Vector3d> turns_;    ///< [rad] rotation vectors in the camera
  std::deque<AngleBelief> roads_;        ///< [rad] roll against the road's plane
  TiltBelief belief_;
};

/// Tilt of a camera from gravity: the mean of an accelerometer at rest or over a drive.
/// @param R_vehicle_cam  from the mounting; its heading counts
/// @param acceleration   specific force in the vehicle frame [m/s²], about +9.8 along Z
[[nodiscard]] Tilt tilt_from_gravity(const Eigen::Matrix3d& R_vehicle_cam,
                                     const Eigen::Vector3d& acceleration);

}  // namespace oneac
