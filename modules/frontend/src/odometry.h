#pragma once

#include "gravity_estimator.h"
#include "local_map.h"
#include "settling.h"
#include "speed_scale.h"
#include "track_store.h"

#include "oneac/frontend/frame_result.h"
#include "oneac/frontend/front_end_options.h"
#include "oneac/frontend/scale_filter.h"
#include "oneac/frontend/suspension_tilt.h"
#include "oneac/frontend/tilt_estimator.h"
#include "oneac/geometry/camera_frame.h"
#include "oneac/initialisers/relative_pose_initialiser.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace oneac {

/// Correspondences in, poses out: everything of the front-end that does not look at pixels.
class Odometry {
 public:
  Odometry(const FrontEndOptions& options, RelativePoseInitialiser::Ptr initialiser);

  /// The first frame; its image is not used.
  [[nodiscard]] FrameResult start(const CameraFrame& frame);
  /// A frame and its correspondences with the one before.
  [[nodiscard]] FrameResult advance(const CameraFrame& frame, StepTracks tracks);
  /// Settles what is left; the next step begins a new segment at the last frame.
  [[nodiscard]] Settled finish();

  /// For the tilt source "imu".
  void add_inertial(const InertialReading& reading);
  /// Speed over ground, for the scale source "gps".
  void add_speed(double time_s, double speed_mps);

  [[nodiscard]] const TiltEstimator* tilt() const { return tilt_ ? &*tilt_ : nullptr; }
  [[nodiscard]] const ScaleFilter& scale() const { return scale_; }
  [[nodiscard]] double camera_height() const { return camera_height_; }
  [[nodiscard]] bool has_moved() const { return frames_ > 1; }
  /// Motion expected for the next step, t as used; identity before the first.
  [[nodiscard]] const RelativePose& last_motion() const { return last_motion_; }

 private:
  /// What the two images say, |t| = 1 or 0.
  struct TwoView {
    StepStatus status = StepStatus::kPredicted;
    RelativePose pose;
    std::vector<bool> inliers;
    std::size_t inlier_count = 0;
  };

  [[nodiscard]] TwoView estimate(StepTracks& tracks, double focal_px, StepResult& step) const;
  void set_length(const StepTracks& tracks, const TwoView& found, const CameraFrame& frame,
                  StepResult& step);
  void measure_pair(const StepTracks& tracks, const TwoView& found, double focal_px,
                    StepResult& step);
  [[nodiscard]] double held_length(double seconds, double time, bool found_motion) const;
  void follow(const StepTracks& tracks, const TwoView& found, StepResult& step);
  void restart(const StepTracks& tracks, const TwoView& found);
  void move(const StepResult& step);
  void update_map(const CameraFrame& frame, const StepTracks& tracks, StepResult& step,
                  FrameResult& result);
  void measure_scale(const StepTracks& tracks, double focal_px, StepResult& step);
  [[nodiscard]] std::optional<ScaleMeasurement> measure_by_road(double focal_px, StepResult& step);
  [[nodiscard]] std::optional<ScaleMeasurement> measure_by_speed();
  [[nodiscard]] Tilt given_tilt() const;
  void rescale(double factor);
  void follow_tilt(const StepResult& step);
  void tell_tilt(FrameResult& result) const;
  /// R_level_cam of the newest frame, pitch on the springs included, and of an earlier one. The
  /// roll is the mounting's: that of the springs is felt by its effect on the pitch only.
  [[nodiscard]] Eigen::Matrix3d leveling() const;
  [[nodiscard]] Eigen::Matrix3d leveling_before(const RelativePose& T_now_before) const;
  [[nodiscard]] GroundScaleOptions ground_scale_options() const;

  FrontEndOptions options_;
  RelativePoseInitialiser::Ptr initialiser_;
  std::optional<TiltEstimator> tilt_;
  std::optional<SuspensionTilt> road_tilt_;
  ScaleFilter scale_;
  double camera_height_ = 0.0;
  Eigen::Matrix3d R_vehicle_cam_ = Eigen::Matrix3d::Identity();
  GravityEstimator gravity_;
  SpeedScale speeds_;

  std::optional<LocalMap> map_;
  Settled pending_;  ///< since the last result
  Settling settling_;
  CameraFrame previous_;
  std::size_t frames_ = 0;  ///< processed
  std::size_t segment_ = 0;
  bool lost_ = false;               ///< the last step was not carried by its images
  double keyframe_time_ = 0.0;      ///< [s] of the last keyframe
  double carried_variance_ = 0.0;   ///< relative, of the lengths that landmarks carried since then
  RelativePose T_cam_map_;          ///< newest frame; the map's frame is the first camera's
  RelativePose last_motion_;        ///< T_2_1 of the last step, length as used
  double last_metric_speed_ = 0.0;  ///< [m/s]
  double last_metric_time_ = 0.0;   ///< [s]
};

}  // namespace oneac
