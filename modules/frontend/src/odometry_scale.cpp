#include "odometry.h"

#include "oneac/robust/ground_scale.h"

#include <cmath>
#include <string>
#include <vector>

namespace oneac {
namespace {

// [-] share of the inlier bound taken as 1σ of a point's position.
constexpr double kSigmaOfThreshold = 0.5;
// [m] first step of a car that moves off, for want of better; the road corrects it.
constexpr double kFirstStep = 0.05;

}  // namespace

void Odometry::measure_pair(const StepTracks& tracks, const TwoView& found, double focal_px,
                            StepResult& step) {
  if (!(camera_height_ > 0.0)) return;
  const double sigma = kSigmaOfThreshold * options_.consensus.threshold_px / focal_px;
  const auto scale =
      ground_scale(tracks.acs, found.inliers, step.pose, leveling(), sigma, ground_scale_options());
  if (!scale) return;
  step.length = scale->baseline * camera_height_;
  step.length_sigma = scale->uncertainty;
  step.ground_acs = scale->support;
  step.metric = true;
}

double Odometry::held_length(double seconds, double time, bool found_motion) const {
  if (last_motion_.t.norm() == 0.0 && last_metric_time_ == 0.0) return 1.0;  // the unit of the map
  const bool too_old = time - last_metric_time_ > options_.max_hold || !(seconds > 0.0);
  const double held = too_old ? last_motion_.t.norm() : last_metric_speed_ * seconds;
  // A map that begins with a car moving off needs some length to measure the road in.
  const bool begins = std::isinf(scale_.uncertainty()) && held < kFirstStep;
  return begins && found_motion ? kFirstStep : held;
}

void Odometry::measure_scale(const StepTracks& tracks, double focal_px, StepResult& step) {
  const std::string& source = options_.scale.source;
  const auto measured = source == "gps"      ? measure_by_speed()
                        : source == "stereo" ? map_->compare_depths(tracks)
                                             : measure_by_road(focal_px, step);
  if (measured) rescale(scale_.correct(measured->ratio, measured->sigma));
}

std::optional<ScaleMeasurement> Odometry::measure_by_road(double focal_px, StepResult& step) {
  if (!(camera_height_ > 0.0)) return std::nullopt;
  const KeyframePair pair = map_->pair_with(1);
  if (!(pair.T_2_1.t.norm() > 0.0)) return std::nullopt;
  const double sigma = kSigmaOfThreshold * options_.consensus.threshold_px / focal_px;
  const auto road = ground_scale(pair.acs, std::vector<bool>(pair.acs.size(), true), pair.T_2_1,
                                 leveling_before(pair.T_2_1), sigma, ground_scale_options());
  if (!road) return std::nullopt;
  step.ground_acs = road->support;
  const double ratio = road->baseline * camera_height_ / pair.T_2_1.t.norm();
  return ScaleMeasurement{ratio, road->uncertainty};
}

std::optional<ScaleMeasurement> Odometry::measure_by_speed() {
  const auto over_an_epoch = speeds_.measure();
  return over_an_epoch || scale_.is_metric() ? over_an_epoch : speeds_.first_guess();
}

void Odometry::add_speed(double time_s, double speed_mps) {
  speeds_.add_speed(time_s, speed_mps);
}

void Odometry::rescale(double factor) {
  if (factor == 1.0) return;
  map_->rescale(factor);
  settling_.rescale(factor);
  speeds_.rescale(factor);
  last_motion_.t *= factor;
}

}  // namespace oneac
