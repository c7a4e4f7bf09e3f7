#pragma once

#include "attitude/levelling.h"
#include "measurements.h"
#include "road_length.h"
#include "speed_scale.h"
#include "two_view/two_view.h"

#include "oneac/frontend/scale_filter.h"
#include "oneac/geometry/camera_frame.h"

#include <optional>
#include <vector>

namespace oneac {

/// A step whose length is asked.
struct StepInTime {
  StepStatus status = StepStatus::kPredicted;
  double begin_s = 0.0, end_s = 0.0;  ///< [s] Unix times of the two frames
  RelativePose expected;              ///< motion of the step before, length as used

  [[nodiscard]] double seconds() const { return end_s - begin_s; }
};

/// How long things are: the one owner of every source of length (the map's own, the road, speeds,
/// stereo, the last speed) and of the filter that weighs them.
///
/// At a step: measure() lists who tells its length, length_of() decides, with 1σ, metric or not,
/// and why. At a keyframe: correct() compares the map with the source of metres; what comes out is
/// the one place by which lengths change afterwards, and everybody who keeps lengths applies it.
class Scale {
 public:
  explicit Scale(const FrontEndOptions& options);

  /// The first frame, whose mount may tell the camera's height.
  void start(const CameraFrame& first);
  /// Speed over ground in time order, for the source "gps".
  void add_speed(const SpeedReading& told);
  /// The map began anew at this time: its scale has to be measured again.
  void restart(double time_s);

  /// Who tells the length of a step, the surest first. The road is asked only when the map does not
  /// carry it.
  /// @param carried  by the landmarks of the map [map]
  [[nodiscard]] std::vector<LengthMeasurement> measure(
      const TwoView& seen, const std::optional<LengthMeasurement>& carried,
      const Levelling& first) const;
  /// The length of the step, which is then remembered as the newest.
  [[nodiscard]] StepLength length_of(const StepInTime& step,
                                     const std::vector<LengthMeasurement>& measured);
  /// A keyframe more in the map.
  /// @param first  levelling of the first view of map.newest
  [[nodiscard]] ScaleCorrection correct(const MapLengths& map, const Levelling& first,
                                        double focal_px);

  [[nodiscard]] double camera_height() const { return road_.camera_height(); }
  /// Of the map's lengths.
  [[nodiscard]] bool is_metric() const { return filter_.is_metric(); }
  /// Relative 1σ of the map's lengths; infinite while nobody has measured them.
  [[nodiscard]] double uncertainty() const { return filter_.uncertainty(); }

 private:
  [[nodiscard]] StepLength decided(const StepInTime& step,
                                   const std::vector<LengthMeasurement>& measured) const;
  [[nodiscard]] StepLength stated(const LengthMeasurement& measured) const;
  /// Relative 1σ up to which a length counts as metric.
  [[nodiscard]] double allowed_sigma(double length) const;
  [[nodiscard]] double held_length(const StepInTime& step) const;
  [[nodiscard]] std::vector<ScaleMeasurement> measure(const MapLengths& map, const Levelling& first,
                                                      double focal_px);
  [[nodiscard]] std::optional<ScaleMeasurement> by_road(const KeyframePair& pair,
                                                        const Levelling& first,
                                                        double focal_px) const;
  [[nodiscard]] std::optional<ScaleMeasurement> by_speed();

  LengthSource metres_;     ///< where the map's metres come from; kNone: from nowhere
  double given_height_;     ///< [m] of the camera above the road; 0: not given
  double max_hold_;         ///< [s]
  double max_uncertainty_;  ///< relative 1σ of a length that counts as metric
  std::size_t least_depths_;
  ScaleFilter filter_;
  RoadLength road_;
  SpeedScale speeds_;
  double carried_variance_ = 0.0;   ///< relative, of what landmarks carried since the last keyframe
  double last_metric_speed_ = 0.0;  ///< [m/s]
  double last_metric_time_ = 0.0;   ///< [s]
};

}  // namespace oneac
