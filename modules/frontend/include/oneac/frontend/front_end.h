#pragma once

#include "oneac/features/ac_extractor.h"
#include "oneac/frontend/front_end_options.h"
#include "oneac/frontend/tilt_estimator.h"
#include "oneac/geometry/camera_frame.h"
#include "oneac/initialisers/relative_pose_initialiser.h"

#include <mrpt/system/COutputLogger.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oneac {

/// A frame with its features: what can be made of one image alone.
struct PreparedFrame {
  CameraFrame frame;  ///< image released
  std::shared_ptr<const FrameFeatures> features;
  double features_ms = 0.0;  ///< CPU time [ms]
};

/// How a step came about.
enum class StepStatus {
  kOk,         ///< estimated from the images
  kNoMotion,   ///< estimated: the camera stood
  kPredicted,  ///< the images did not carry it: the last motion goes on
};
[[nodiscard]] const char* to_string(StepStatus status);

/// The motion from the frame before to this one.
struct StepResult {
  std::size_t index1 = 0, index2 = 0;  ///< images of the camera in the log
  double time1 = 0.0, time2 = 0.0;     ///< [s] Unix time
  StepStatus status = StepStatus::kPredicted;
  RelativePose pose;    ///< T_2_1, camera optical frame; t in metres when metric, else |t| = 1 or 0
  bool metric = false;  ///< t is in metres: from the road and the camera height, or the car stood
  double length =
      0.0;  ///< [m, or units when the drive has no scale yet] step used in the trajectory
  double length_sigma = 0.0;   ///< relative 1σ of a metric length
  std::size_t acs = 0;         ///< affine correspondences of the pair
  std::size_t inliers = 0;     ///< of them that obey the pose
  std::size_t ground_acs = 0;  ///< of them on the road
  double features_ms = 0.0, estimate_ms = 0.0, refine_ms = 0.0;  ///< CPU time [ms]
};

/// Pose of one frame and how it came about.
struct FrameResult {
  std::size_t index = 0;
  double time_s = 0.0;
  Eigen::Isometry3d T_first_cam =
      Eigen::Isometry3d::Identity();  ///< camera in the first camera's frame
  std::optional<StepResult> step;     ///< none for the first frame
};

/// Frame in, pose out: the visual front-end of a vehicle with one camera.
///
/// prepare → correspond → initialise (one-AC consensus) → refine → scale from the road →
/// concatenate. No I/O, no threads, no global state: many instances may live in one process. Logs
/// through COutputLogger.
class FrontEnd : public mrpt::system::COutputLogger {
 public:
  /// @throws std::invalid_argument for options out of bounds, InputError for an unknown initialiser
  explicit FrontEnd(const FrontEndOptions& options);

  /// The part that may run on any thread and ahead of time.
  [[nodiscard]] PreparedFrame prepare(CameraFrame frame) const;
  /// The part that goes frame by frame, in time order.
  [[nodiscard]] FrameResult process(PreparedFrame prepared);

  /// The camera's tilt as believed now; the log's, corrected by the drive.
  [[nodiscard]] Tilt tilt() const;
  /// [m] height of the camera above the road in use; 0 when unknown, then nothing is metric.
  [[nodiscard]] double camera_height() const { return camera_height_; }

 private:
  void start(const PreparedFrame& first);
  [[nodiscard]] StepResult estimate_step(const PreparedFrame& now);
  [[nodiscard]] RelativePose refined(const InitialiserInput& input, const InitialiserResult& found);
  void set_length(StepResult& step, AcSpan acs, const InitialiserResult& found,
                  const CameraFrame& frame);
  [[nodiscard]] double held_length(double time) const;
  void remember(const StepResult& step);

  FrontEndOptions options_;
  std::unique_ptr<AcExtractor> extractor_;
  RelativePoseInitialiser::Ptr initialiser_;

  // The drive so far.
  std::optional<TiltEstimator> tilt_;
  double camera_height_ = 0.0;
  std::optional<PreparedFrame> previous_;
  Eigen::Isometry3d T_first_cam_ = Eigen::Isometry3d::Identity();
  RelativePose last_motion_;        ///< T_2_1 of the last step, length as used
  double last_metric_speed_ = 0.0;  ///< [m/s]
  double last_metric_time_ = 0.0;   ///< [s]
};

}  // namespace oneac
