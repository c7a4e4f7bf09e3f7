#pragma once

#include "attitude/levelling.h"
#include "inertia.h"
#include "measurements.h"
#include "road_length.h"
#include "road_travel.h"
#include "speed_scale.h"
#include "two_view/two_view.h"

#include "oneac/frontend/scale_filter.h"
#include "oneac/geometry/camera_frame.h"

#include <cmath>
#include <optional>
#include <vector>

namespace oneac {

/// A step whose length is asked.
struct StepInTime {
  StepStatus status = StepStatus::kPredicted;
  double begin_s = 0.0, end_s = 0.0;     ///< [s] Unix times of the two frames
  RelativePose expected;                 ///< motion of the step before, length as used
  std::optional<MeasuredTravel> direct;  ///< what the road's grey values or stereo say of it
  double resting = 1.0;                  ///< share of the points that rest, of a step at rest
  bool car_is_known = true;              ///< what rests in the images is not the car's own
  bool began_at_rest = true;             ///< so says FirstRest; asked while nothing has moved
  bool shows_travel = false;             ///< the images show travel, whatever rests in them
  bool through_dirt = false;             ///< what rests may be drops or dirt on the glass
  bool repeated = false;                 ///< it shows the image before once more, see RepeatedView

  /// It is a rest, of this share of the points.
  void rests(StepStatus rest, double share) {
    status = rest;
    resting = share;
  }
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
  /// Speed over ground in time order, for the sources "gps" and "wheels".
  void add_speed(const SpeedReading& told);
  /// Relative 1σ that every length by images has beside its own, from here on: the camera's focal
  /// length is in doubt. Lengths by speeds do not know it.
  void doubt_camera(double relative_sigma) { camera_doubt_ = relative_sigma; }
  /// The map began anew at this time: its scale has to be measured again.
  void restart(double time_s);

  /// Who tells the length of a step, the surest first. The road is asked only when the map does not
  /// carry it.
  /// @param carried  by the landmarks of the map [map]
  /// @param heading  t̂ of a camera that goes on as it did
  [[nodiscard]] std::vector<LengthMeasurement> measure(
      const TwoView& seen, const std::optional<LengthMeasurement>& carried, const Levelling& first,
      const Eigen::Vector3d& heading) const;
  /// What the step itself says of its length: depths by stereo where these are the metres, else
  /// the grey values of the road, asked where they are needed: where the map does not carry the
  /// length, where rest is in question, and now and then as a check.
  /// @param heading  t̂ of a camera that goes on as it did
  [[nodiscard]] std::optional<MeasuredTravel> measure_directly(
      const RoadPair& road, const TwoView& seen, const std::optional<LengthMeasurement>& carried,
      const Levelling& first, const Eigen::Vector3d& heading, const StepInTime& step);
  /// The images show a motion, but the car may stand, and the road rests: it is traffic that moves.
  /// @return what the road says of the rest; empty when it is none
  [[nodiscard]] std::optional<MeasuredTravel> rest_by_road(const RoadPair& road,
                                                           const TwoView& seen,
                                                           const Levelling& first,
                                                           const Eigen::Vector3d& heading,
                                                           const StepInTime& step);
  /// What inertia lets expect; empty while no speed is known.
  [[nodiscard]] std::optional<ExpectedLength> expected(double begin_s, double end_s) const {
    return inertia_.expect(begin_s, end_s);
  }
  /// Every step since the last keyframe was measured.
  [[nodiscard]] bool lengths_hold() const { return interval_.is_told() || filter_.is_metric(); }
  /// Road and map have contradicted each other for too long: the map should begin anew.
  [[nodiscard]] bool map_is_refuted() const { return conflicts_ >= kPatience; }
  /// A step of a map that has no scale yet is told in metres: the whole map is from now on.
  /// @param carried  length of the step by the map's landmarks [map]
  /// @return the correction of the map's lengths; empty when this step begins no scale
  [[nodiscard]] std::optional<ScaleCorrection> begin(const StepInTime& step,
                                                     const LengthMeasurement& carried);
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
  /// Stamps are not those of the images: steps that map and road agree on would need accelerations
  /// that no tyre gives, again and again. Inertia tells no metres then.
  [[nodiscard]] bool stamps_are_wrong() const { return beside_stamps_ >= kWrongStamps; }
  /// Relative 1σ of every length, in metres by images, that the camera's doubt adds.
  [[nodiscard]] double camera_doubt() const {
    return metres_ == LengthSource::kSpeed ? 0.0 : camera_doubt_;
  }

 private:
  static constexpr int kPatience = 5;     ///< steps in a row
  static constexpr int kWrongStamps = 3;  ///< steps of a drive: one and two may be a gap
  /// [σ] Two lengths of one step that are farther apart contradict each other.
  static constexpr double kContradiction = 4.0;
  /// [-] Share of the bound on a metric length up to which it needs no help.
  static constexpr double kSure = 0.5;

  static constexpr double kMostUntold = 0.2;  ///< [-] share of a way that is still told by the rest
  static constexpr double kUntold = 0.3;      ///< relative 1σ of a length that inertia alone told
  static constexpr double kCreep = 0.15;      ///< [m] four times what noise made of a bonnet

  /// What landmarks carried over several steps.
  class Carried {
   public:
    void add(double length, double relative_sigma);
    /// A step of this length [map] that the landmarks did not tell.
    void add_untold(double length) { untold_ += length; }
    /// The map's lengths were multiplied.
    void rescale(double factor) {
      way_ *= factor;
      untold_ *= factor;
      absolute_ *= factor * factor;
    }
    /// Whether the steps add up to the way [map] between the two keyframes, as they stand in the
    /// map. Where they do not, its landmarks and its poses are of two scales.
    [[nodiscard]] bool adds_up_to(double way) const;
    /// Relative variance of the way: that of its steps; more of them than landmarks usually live
    /// for are those of a car that creeps, all seen by the same, and only its ends are uncertain.
    [[nodiscard]] double variance() const;

   private:
    double steps_ = 0.0, way_ = 0.0, relative_ = 0.0, absolute_ = 0.0, untold_ = 0.0;
  };

  /// Since the last keyframe: the way as others than the map tell it.
  struct Interval {
    double way = 0.0;      ///< [m]
    double sigma_m = 0.0;  ///< [m] the sum of those of its steps: their errors are alike
    double untold = 0.0;   ///< [m] of it that nobody told
    double used = 0.0;     ///< as the steps were used
    double seen = 0.0;     ///< [m] of it that road images told ...
    double reached = 0.0;  ///< [heights² m] ... times the square of how far ahead they looked

    /// [heights]
    [[nodiscard]] double reach() const { return seen > 0.0 ? std::sqrt(reached / seen) : 0.0; }

    /// The map's lengths were multiplied.
    void rescale(double factor) { used *= factor; }
    /// Somebody told as good as all of it.
    [[nodiscard]] bool is_told() const { return way > 0.0 && untold <= kMostUntold * way; }
    [[nodiscard]] double sigma() const { return std::hypot(sigma_m, untold * kUntold) / way; }
  };

  [[nodiscard]] StepLength decided(const StepInTime& step,
                                   const std::vector<LengthMeasurement>& measured) const;
  [[nodiscard]] StepLength chosen(const std::vector<StepLength>& told,
                                  const StepInTime& step) const;
  [[nodiscard]] std::optional<StepLength> against_inertia(
      const std::vector<StepLength>& refused) const;
  /// The road that tells lengths is so far ahead [heights].
  void look_ahead(double reach);
  /// Relative 1σ of lengths for the road's curve between the car and what is looked at.
  [[nodiscard]] double curve_doubt() const;
  /// Relative 1σ of lengths for the road's fall from side to side against the camera's roll.
  [[nodiscard]] double roll_doubt() const;
  /// Relative 1σ that all lengths share beside their own: by camera, roll and that curve.
  [[nodiscard]] double shared_doubt() const {
    return std::hypot(camera_doubt(), curve_doubt(), roll_doubt());
  }
  [[nodiscard]] double road_doubt(LengthSource source) const;
  [[nodiscard]] StepLength with_doubt(StepLength length) const;
  [[nodiscard]] StepLength together(const StepLength& a, const StepLength& b,
                                    const std::optional<ExpectedLength>& expected) const;
  /// Whether two lengths of one step cannot both be true.
  [[nodiscard]] static bool contradict(const StepLength& a, const StepLength& b);
  /// Whether inertia does not allow what is known of a length, be it ever so unsure.
  [[nodiscard]] static bool is_against(const StepLength& told,
                                       const std::optional<ExpectedLength>& expected);
  /// Whether a vehicle seldom does what is told.
  [[nodiscard]] static bool is_unlikely(const StepLength& told,
                                        const std::optional<ExpectedLength>& expected);
  [[nodiscard]] bool may_have_slipped(const StepLength& told, const StepInTime& step) const;
  [[nodiscard]] StepLength steadied(const StepLength& told, const ExpectedLength& expected) const;
  [[nodiscard]] StepLength held(const StepInTime& step) const;
  [[nodiscard]] StepLength at_rest(const StepInTime& step) const;
  [[nodiscard]] StepLength by_itself(const StepInTime& step) const;
  [[nodiscard]] bool may_be_the_car(const StepLength& told, const StepInTime& step) const;
  /// What the length of such a step shares with those around it: relative 1σ.
  [[nodiscard]] double common_sigma(LengthSource source) const;
  void weigh_inertia(const StepLength& length);
  void remember(const StepInTime& step, const StepLength& length);
  [[nodiscard]] std::optional<ScaleMeasurement> by_interval(const KeyframePair& pair) const;
  [[nodiscard]] StepLength stated(const LengthMeasurement& measured) const;
  /// Relative 1σ up to which a length counts as metric.
  [[nodiscard]] double allowed_sigma(double length) const;
  [[nodiscard]] double held_length(const StepInTime& step) const;
  [[nodiscard]] std::vector<ScaleMeasurement> measure(const MapLengths& map, const Levelling& first,
                                                      double focal_px);
  [[nodiscard]] std::optional<MeasuredTravel> unless_it_repeats(const RoadTravel& told,
                                                                bool predicted);
  [[nodiscard]] bool corners_may_slip() const;
  [[nodiscard]] std::optional<ScaleMeasurement> by_road(const KeyframePair& pair,
                                                        const Levelling& first,
                                                        double focal_px) const;
  [[nodiscard]] std::optional<ScaleMeasurement> by_speed();
  /// Nothing that the map says of lengths is believed, and it begins anew.
  [[nodiscard]] ScaleCorrection without_scale(ScaleCorrection correction);
  /// A correction that the filter has taken, with how sure the map is after it.
  [[nodiscard]] ScaleCorrection corrected(ScaleCorrection correction);

  LengthSource metres_;     ///< where the map's metres come from; kNone: from nowhere
  double given_height_;     ///< [m] of the camera above the road; 0: not given
  double max_hold_;         ///< [s]
  double max_uncertainty_;  ///< relative 1σ of a length that counts as metric
  std::size_t least_depths_;
  ScaleFilter filter_;
  RoadLength road_;
  SpeedScale speeds_;
  bool one_speed_begins_;  ///< before two are known: a receiver's, which come a second apart
  Carried carried_;        ///< since the last keyframe
  double last_metric_speed_ = 0.0;  ///< [m/s]
  double last_metric_time_ = 0.0;   ///< [s]
  Inertia inertia_;
  Interval interval_;
  int road_repeats_ = 0;          ///< looks at all lengths that the road must tell apart again
  bool needs_road_image_ = true;  ///< the road's corners did not measure the last keyframe
  bool moved_ = false;            ///< a motion was seen since the drive began
  int unchecked_ = 0;             ///< steps since the road's grey values were asked
  int conflicts_ = 0;             ///< steps in a row in which road and map disagreed
  int contradicted_ = 0;          ///< steps in a row in which nobody agreed with inertia
  int held_ = 0;                  ///< steps in a row that inertia alone told
  int beside_stamps_ = 0;  ///< steps in which two others agreed on what inertia does not allow
  double camera_doubt_ = 0.0;
  double road_uncertainty_;  ///< [-] 1σ of the height above the road ahead
  double roll_sigma_ = 0.0;  ///< [rad] 1σ of the camera's roll against the road
  double reach2_ = 0.0;      ///< [heights²] of the road that lengths rest on
  bool doubted_ = false;     ///< somebody told metres that inertia does not allow, and nobody since
};

}  // namespace oneac
