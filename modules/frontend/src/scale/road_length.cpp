#include "road_length.h"

#include "room.h"

#include "oneac/geometry/angles.h"

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

// [-] share of the inlier bound taken as 1σ of a point's position.
constexpr double kSigmaOfThreshold = 0.5;

/// A levelling that is not sure of its angles sees the road tilted by so much more.
GroundScaleOptions widened(GroundScaleOptions options, const Levelling& levelling) {
  options.plane_tilt_deg = std::hypot(options.plane_tilt_deg, levelling.pitch_sigma / kDegree);
  options.cross_fall_deg = std::hypot(options.cross_fall_deg, levelling.roll_sigma / kDegree);
  return options;
}

}  // namespace

RoadLength::RoadLength(const GroundScaleOptions& options, double threshold_px)
    : options_(options), point_sigma_px_(kSigmaOfThreshold * threshold_px) {}

std::optional<LengthMeasurement> RoadLength::measure(AcSpan acs, const std::vector<bool>& inliers,
                                                     const RelativePose& T_2_1,
                                                     const Levelling& first,
                                                     double focal_px) const {
  if (!(camera_height_ > 0.0)) return std::nullopt;
  GroundScaleOptions options = widened(options_, first);
  options.max_side = std::min(options.max_side, kStrip_m / camera_height_);
  const auto road =
      ground_scale(acs, inliers, T_2_1, first.R_level_cam, point_sigma_px_ / focal_px, options);
  if (!road) return std::nullopt;
  const double heights = road->baseline / T_2_1.t.norm();
  if (!is_wide_enough(heights * room_beside(acs, inliers, T_2_1))) return std::nullopt;
  return LengthMeasurement{road->baseline * camera_height_, road->uncertainty, LengthSource::kRoad,
                           road->support, road->reach};
}

}  // namespace oneac
