#include "oneac/frontend/tilt_estimator.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace oneac {
namespace {

// cos 25°: beyond it the car manoeuvres, and the elevation of t mixes with roll.
constexpr double kMainlyForward = 0.9;
// [rad] a direction of travel more than 15° above or below the given horizon is no drive.
constexpr double kLargestElevation = 0.26;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

TiltEstimator::TiltEstimator(const Tilt& given, const TiltOptions& options)
    : given_(given), options_(options) {}

void TiltEstimator::add_step(const Eigen::Vector3d& t_cam) {
  if (!options_.refine || !(t_cam.norm() > 0.0)) return;
  // Points move against the camera: it travels along −t.
  const Eigen::Vector3d travel = leveling_rotation(given_) * (-t_cam.normalized());
  if (!(std::abs(travel.z()) > kMainlyForward)) return;
  // A camera pitched up sees its travel below the axis (Y down > 0); backing reverses both signs.
  const double elevation = std::atan2(travel.y(), travel.z() > 0.0 ? travel.z() : -travel.z()) *
                           (travel.z() > 0.0 ? 1.0 : -1.0);
  if (std::abs(elevation) > kLargestElevation) return;
  elevations_.push_back(elevation);
  if (elevations_.size() > static_cast<std::size_t>(options_.window_steps)) {
    elevations_.pop_front();
  }
  const double count = static_cast<double>(elevations_.size());
  const double trust = count / (count + options_.prior_steps);
  correction_ = trust * median({elevations_.begin(), elevations_.end()});
}

Tilt TiltEstimator::tilt() const {
  return {given_.pitch_up + correction_, given_.roll_right};
}

}  // namespace oneac
