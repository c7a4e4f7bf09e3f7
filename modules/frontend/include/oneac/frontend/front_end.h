#pragma once

#include "oneac/features/ac_tracker.h"
#include "oneac/frontend/frame_result.h"
#include "oneac/frontend/front_end_options.h"
#include "oneac/frontend/tilt_estimator.h"
#include "oneac/geometry/camera_frame.h"
#include "oneac/geometry/leveling.h"
#include "oneac/initialisers/relative_pose_initialiser.h"

#include <mrpt/system/COutputLogger.h>
#include <mrpt/system/CTimeLogger.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace mrpt::obs {
class CObservation;
}

namespace oneac {

class Odometry;

/// A frame with its features: what can be made of one image alone.
struct PreparedFrame {
  CameraFrame frame;
  std::shared_ptr<const FrameFeatures> features;
  double features_ms = 0.0;  ///< CPU time [ms]
};

/// Frame in, pose out: the visual front-end of a vehicle with one camera.
///
/// track → initialise (any RelativePoseInitialiser) → refine the pair → length from the local map,
/// else from the road → keyframe decision → adjust the window → correct the scale. No I/O, no
/// threads, no global state: many instances may live in one process. Logs through COutputLogger.
class FrontEnd : public mrpt::system::COutputLogger {
 public:
  /// @throws std::invalid_argument for options out of bounds, InputError for an unknown initialiser
  explicit FrontEnd(const FrontEndOptions& options);
  ~FrontEnd() override;

  /// The part that may run on any thread and ahead of time.
  [[nodiscard]] PreparedFrame prepare(CameraFrame frame) const;
  /// The part that goes frame by frame, in time order.
  [[nodiscard]] FrameResult process(PreparedFrame prepared);
  /// An observation in time order: an image (of a stereo pair the left one) gives a result; GPS and
  /// IMU are remembered for scale and tilt; everything else, an image that cannot be loaded and one
  /// that is not later than the last are passed over.
  /// @throws InputError for an image without usable calibration
  std::optional<FrameResult> feed(const std::shared_ptr<mrpt::obs::CObservation>& observation);
  /// Specific force in the vehicle frame [m/s²]: gravity, for tilt.source "imu"; with the yaw rate
  /// [rad/s], where there is one, turns do not count as leaning.
  void add_acceleration(double time_s, const Eigen::Vector3d& acceleration,
                        std::optional<double> yaw_rate = std::nullopt);
  /// Speed over ground in time order, for scale.source "gps"; offline a second or two ahead of the
  /// images.
  void add_speed(double time_s, double speed_mps);
  /// CPU time of the stages so far, by name.
  [[nodiscard]] const mrpt::system::CTimeLogger& profiler() const { return profiler_; }
  /// Makes everything final that still waits, at the end of a drive.
  [[nodiscard]] Settled finish();

  /// The camera's tilt as believed now; the log's, corrected by the drive.
  [[nodiscard]] Tilt tilt() const;
  /// The same with its uncertainty.
  [[nodiscard]] TiltBelief tilt_belief() const;
  /// Correspondences [px] from the frame before to the last one processed, for viewers.
  [[nodiscard]] const TrackedPair& correspondences() const { return correspondences_; }
  /// [m] height of the camera above the road in use; 0 when unknown, then nothing is metric.
  [[nodiscard]] double camera_height() const;
  /// Relative 1σ of the lengths of the map; infinite while nothing has measured them.
  [[nodiscard]] double scale_uncertainty() const;

 private:
  /// What the tracker may expect of the next step.
  [[nodiscard]] MotionHint hint() const;

  FrontEndOptions options_;
  std::unique_ptr<AcTracker> tracker_;
  std::unique_ptr<Odometry> odometry_;
  bool started_ = false;
  PinholeCamera previous_camera_;
  TrackedPair correspondences_;
  std::string fed_label_;     ///< camera that feed() follows
  std::size_t fed_ = 0;       ///< its images
  double fed_time_ = -1e300;  ///< [s] of the last one
  mrpt::system::CTimeLogger profiler_;
};

}  // namespace oneac
