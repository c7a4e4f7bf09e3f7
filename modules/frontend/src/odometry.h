#pragma once

#include "attitude/attitude.h"
#include "map/keyframe_map.h"
#include "scale/first_rest.h"
#include "scale/scale.h"
#include "setup/setup_check.h"
#include "two_view/repeated_view.h"
#include "two_view/turn_gate.h"
#include "two_view/two_view.h"

#include "oneac/frontend/frame_result.h"
#include "oneac/frontend/front_end_options.h"
#include "oneac/geometry/camera_frame.h"
#include "oneac/initialisers/relative_pose_initialiser.h"

#include <optional>
#include <vector>

namespace oneac {

class Workers;

/// Correspondences in, poses out: everything of the front-end that does not look at pixels. Four
/// rooms, each the one owner of its truth: two views, attitude, scale, map; docs/architecture.md.
class Odometry {
 public:
  /// @param workers  who shares the work of a step, and outlives it; none: the calling thread alone
  Odometry(const FrontEndOptions& options, RelativePoseInitialiser::Ptr initialiser,
           Workers* workers = nullptr);

  /// The first frame; its image is not used.
  [[nodiscard]] FrameResult start(const CameraFrame& frame);
  /// A frame and its correspondences with the one before, normalised.
  /// @param road  grey values of both images; may be empty
  [[nodiscard]] FrameResult advance(const CameraFrame& frame, TrackedPair pair,
                                    const RoadPair& road);
  /// Settles what is left; the next step begins a new segment at the last frame.
  [[nodiscard]] Settled finish() { return map_.finish(); }
  [[nodiscard]] SettledTracks take_tracks() { return map_.take_tracks(); }

  /// Why the camera cannot be as given, or nothing: until told otherwise.
  void blame_camera(const std::optional<std::string>& fault) { setup_.blame_camera(fault); }
  /// Relative 1σ that lengths by images have by the camera, from the next step on.
  void doubt_camera(double relative_sigma) { scale_.doubt_camera(relative_sigma); }
  /// Normalised coordinates of the frames to come are longer by this factor.
  void renormalise(const CameraChange& change) { map_.renormalise(change); }

  /// For the tilt source "imu".
  void add_inertial(const InertialReading& reading) { attitude_.add_inertial(reading); }
  /// Speed over ground, for the scale sources "gps" and "wheels".
  void add_speed(const SpeedReading& told) { scale_.add_speed(told); }

  [[nodiscard]] const Attitude& attitude() const { return attitude_; }
  [[nodiscard]] const Scale& scale() const { return scale_; }
  [[nodiscard]] const SetupCheck& setup() const { return setup_; }
  /// The newest frame, when it became a keyframe.
  [[nodiscard]] std::optional<NewestKeyframe> newest_keyframe() const { return map_.newest(); }
  /// Motion expected for the next step, length as used; none before the first.
  [[nodiscard]] std::optional<RelativePose> expected() const;

 private:
  [[nodiscard]] FrameResult integrate(const FrameStamp& now, TwoView seen, const RoadPair& road);
  /// What is made of those who tell the step's length; set-up and course learn from it.
  [[nodiscard]] StepLength length_of(const StepInTime& step, const TwoView& seen,
                                     const std::vector<LengthMeasurement>& told);
  /// The map with the step in it.
  [[nodiscard]] FrameResult moved(const FrameStamp& now, const TwoView& seen,
                                  const StepResult& step);
  [[nodiscard]] MotionPrior motion_prior(double end_s) const;
  struct SeenInTime {
    TwoView seen;
    StepInTime in_time;
  };
  /// What two views told, or a rest where the road says so; refused where no car does it.
  [[nodiscard]] SeenInTime believed(const FrameStamp& before, const FrameStamp& now, TwoView seen,
                                    const RoadPair& road);
  /// Whether the image shows what the one before it showed, though the car cannot have stopped as
  /// far as its speed is known.
  [[nodiscard]] bool repeats(const TwoView& seen, const FrameStamp& before, const FrameStamp& now);
  /// Whether the car's wheels can take the direction that two views told.
  [[nodiscard]] bool is_on_wheels(const TwoView& seen) const;
  /// Whether a car that cannot even have come to a stop is seen going the other way: tracks have
  /// slipped along a road that repeats.
  [[nodiscard]] bool turns_back(const TwoView& seen, const FrameStamp& before,
                                const FrameStamp& now);
  /// t̂ of a camera that goes on as it did.
  [[nodiscard]] Eigen::Vector3d heading() const;
  /// t̂ of a camera that travels as it is mounted.
  [[nodiscard]] Eigen::Vector3d straight_ahead() const;
  /// A step in metres is the first that tells the map's scale: the map is in metres from here on.
  [[nodiscard]] std::optional<ScaleCorrection> begin_scale(
      const StepInTime& step, const std::optional<LengthMeasurement>& carried);
  [[nodiscard]] std::optional<ScaleCorrection> scale_correction(
      const std::optional<MapLengths>& lengths, double focal_px);

  Workers* workers_;
  TwoViewEstimator two_view_;
  TurnGate turn_gate_;
  RepeatedView repeated_;
  CourseBelief course_;
  Attitude attitude_;
  FirstRest first_rest_;
  Scale scale_;
  SetupCheck setup_;
  KeyframeMap map_;
  FrameStamp newest_;                                  ///< frame
  RelativePose T_cam_odom_;                            ///< by the steps alone
  RelativePose last_motion_;                           ///< T_2_1 of the last step, length as used
  Eigen::Vector3d heading_ = Eigen::Vector3d::Zero();  ///< t̂ of the last step that had one
  std::optional<double> back_since_;                   ///< [s] what goes the other way is refused
  bool came_to_rest_ = true;                           ///< by the step before
};

}  // namespace oneac
