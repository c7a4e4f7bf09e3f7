#pragma once

#include "oneac/base/image.h"
#include "oneac/features/ac_tracker.h"
#include "oneac/features/road_alignment.h"
#include "oneac/frontend/camera_belief.h"
#include "oneac/frontend/drive_trajectory.h"
#include "oneac/frontend/frame_result.h"
#include "oneac/frontend/front_end_options.h"
#include "oneac/frontend/tilt_estimator.h"
#include "oneac/geometry/camera_frame.h"
#include "oneac/geometry/levelling.h"
#include "oneac/initialisers/relative_pose_initialiser.h"
#include "oneac/observations/observation_intake.h"

#include <mrpt/system/COutputLogger.h>
#include <mrpt/system/CTimeLogger.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mrpt::obs {
class CObservation;
}

namespace oneac {

class CameraLearner;
class Odometry;
class Workers;

/// A frame with its features: what can be made of one image alone.
struct PreparedFrame {
  CameraFrame frame;
  std::shared_ptr<const FrameFeatures> features;
  double features_ms = 0.0;  ///< CPU time [ms]
};

/// Frame in, pose out: the visual front-end of a vehicle with one camera.
///
/// track → initialise (any RelativePoseInitialiser) → refine the pair → length from the local map,
/// else from the road → keyframe decision → adjust the window → correct the scale. No I/O but the
/// external images of observations, no global state, no threads but those asked for: many instances
/// may live in one process. Logs through COutputLogger.
///
/// What throws what: numbers and pointers that the caller makes up are misuse when they are out of
/// bounds, std::invalid_argument; what an observation holds is input, InputError for an image of
/// the camera, and passed over for IMU, GPS and wheels, which only help.
class FrontEnd : public mrpt::system::COutputLogger {
 public:
  /// @param threads  that share the work of process(), the caller among them: it tracks on all of
  ///                 them. Changes no result; below 2 no thread is started, more than 64 are not
  /// @throws std::invalid_argument for options out of bounds, InputError for an unknown initialiser
  explicit FrontEnd(const FrontEndOptions& options, int threads = 1);
  ~FrontEnd() override;

  /// The part that may run on any thread and ahead of time.
  [[nodiscard]] PreparedFrame prepare(CameraFrame frame) const;
  /// The part that goes frame by frame, in time order.
  /// @throws std::invalid_argument when the image has another size than those before
  [[nodiscard]] FrameResult process(PreparedFrame prepared);
  /// An observation as it comes: an image of the camera gives a result, in order of time; GPS and
  /// IMU are remembered for scale and tilt. What is passed over is counted in fed() and logged, the
  /// first time for each reason. ObservationIntake says what is followed and what refused, in the
  /// words of `oneac run`; after a refusal feeding may go on.
  /// @param masks  of this image and, with scale.source "stereo", of the right one: dark where
  ///               pixels are not used, of the size that the observation has them in
  /// @throws InputError for an image of the camera that cannot be used: no calibration, another
  ///         lens model than plumb-bob, calibration or size that change, damaged pose, no time
  ///         stamp, not decodable; std::invalid_argument for a null pointer, and a mask of another
  ///         size
  std::optional<FrameResult> feed(const std::shared_ptr<mrpt::obs::CObservation>& observation,
                                  const ImageMasks& masks = {});
  /// What became of the observations so far.
  [[nodiscard]] const IntakeCounts& fed() const { return intake_.counts(); }
  /// Specific force in the vehicle frame [m/s²]: gravity, for tilt.source "imu"; with the yaw rate
  /// [rad/s], where there is one, turns do not count as leaning.
  /// @throws std::invalid_argument naming argument, value and bound beyond SensorLimits, or when
  ///         not finite; nothing is taken then
  void add_acceleration(double time_s, const Eigen::Vector3d& acceleration,
                        std::optional<double> yaw_rate = std::nullopt);
  /// Speed over ground [m/s] with its 1σ, for scale.source "gps" or "wheels"; offline a second or
  /// two ahead of the images. One that is not later than the last is not used.
  /// @throws std::invalid_argument as add_acceleration does; a speed is from 0 on, its 1σ above 0
  void add_speed(double time_s, double speed_mps, double sigma_mps = SpeedReading::kDoppler);
  /// The vehicle's yaw rate [rad/s], counter-clockwise, and a course over ground [rad], clockwise
  /// from north, with the speed [m/s]: turns for front_end.calibration.refine, else not used. In
  /// order of time; they may lie ahead of the images. feed() takes those of its IMU and GPS.
  /// @throws std::invalid_argument as add_acceleration does; a course is within two full turns
  void add_yaw_rate(double time_s, double yaw_rate);
  void add_course(double time_s, double course, double speed_mps);
  /// CPU time of the stages so far, by name, over all threads.
  [[nodiscard]] const mrpt::system::CTimeLogger& profiler() const { return profiler_; }
  /// Makes everything final that still waits, at the end of a drive. Frames that come after it
  /// begin a new segment, which the next finish() makes final.
  Settled finish();
  /// Tracks that have settled since the last call, with window.keep_sightings; else nothing.
  [[nodiscard]] SettledTracks take_tracks();
  /// The camera's way so far, a row per frame: final where settled, and wholly after finish().
  [[nodiscard]] const DriveTrajectory& trajectory() const { return trajectory_; }
  /// Without it trajectory() stays empty: for a drive of any length, whose results go elsewhere.
  void keep_trajectory(bool keep) { keeps_trajectory_ = keep; }

  /// The camera's tilt as believed now; the log's, corrected by the drive.
  [[nodiscard]] Tilt tilt() const;
  /// The same with its uncertainty.
  [[nodiscard]] TiltBelief tilt_belief() const;
  /// Correspondences [px] from the frame before to the last one processed, for viewers.
  [[nodiscard]] const TrackedPair& correspondences() const { return correspondences_; }
  /// The camera as given, as used, and as the bends say; front_end.calibration.
  [[nodiscard]] const CameraBelief& camera_belief() const;
  /// The newest frame, when it became a keyframe.
  [[nodiscard]] std::optional<NewestKeyframe> newest_keyframe() const;
  /// What belongs to the car as learned so far (bonnet, wipers): black there, white elsewhere, of
  /// the images' size; empty while nothing was learned.
  [[nodiscard]] GreyImage car_mask() const;
  /// Whether more of the images looked like the car than a drive can lose, so that none is masked.
  [[nodiscard]] bool car_mask_refused() const;
  /// [m] height of the camera above the road in use; 0 when unknown, then nothing is metric.
  [[nodiscard]] double camera_height() const;
  /// What speaks against calibration and mount as they are believed, one line each with its cure;
  /// while there is something, no step is metric.
  [[nodiscard]] const std::vector<std::string>& setup_faults() const;
  /// Relative 1σ that lengths in metres by images have for what bends say against the given focal
  /// length; part of StepResult::length_sigma from there on. doubt_metres() states it in steps
  /// before.
  [[nodiscard]] double length_doubt() const;
  /// Lengths that landmarks and road agree on would need accelerations that no car has, again and
  /// again: the stamps are not those of the images.
  [[nodiscard]] bool stamps_are_wrong() const;
  /// Relative 1σ of the lengths of the map; infinite while nothing has measured them.
  [[nodiscard]] double scale_uncertainty() const;

 private:
  /// What the tracker may expect of the next step.
  [[nodiscard]] MotionHint hint() const;
  /// Takes what a new keyframe says about the camera, for the frames to come.
  void learn_camera(const FrameResult& result);
  /// The first time that observations are passed over for this reason.
  void log_first(PassedOver reason) const;

  FrontEndOptions options_;
  bool stereo_;  ///< metres come from the right images
  bool wheels_;  ///< metres come from an odometer
  std::shared_ptr<Workers> workers_;
  std::unique_ptr<AcTracker> tracker_;
  std::unique_ptr<Odometry> odometry_;
  std::unique_ptr<CameraLearner> learner_;
  bool started_ = false;
  PinholeCamera previous_camera_;
  RoadImage previous_road_;
  TrackedPair correspondences_;
  ObservationIntake intake_;
  DriveTrajectory trajectory_;
  bool keeps_trajectory_ = true;
  mrpt::system::CTimeLogger profiler_;
};

}  // namespace oneac
