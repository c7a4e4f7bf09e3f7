#include "oneac/comparison/pair_reference.h"
#include "oneac/evaluation/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace oneac {
namespace {

constexpr double kStanding = 0.5;    // [m/s] below which a course is noise of another kind
constexpr double kLongestGap = 5.0;  // [s] courses further apart are not one curve
constexpr double kTau = 6.283185307179586;

struct TimedValue {
  double time_s;
  double value;
};

/// Courses while driving, without jumps of a full turn.
std::vector<TimedValue> driving_courses(const VehicleReference& vehicle) {
  std::vector<TimedValue> courses;
  for (const GpsFix& fix : vehicle.gps) {
    if (!fix.course || (fix.speed && *fix.speed < kStanding)) continue;
    const double before = courses.empty() ? *fix.course : courses.back().value;
    courses.push_back({fix.time_s, before + std::remainder(*fix.course - before, kTau)});
  }
  return courses;
}

/// Residual of the middle one of five evenly spaced values against their least-squares parabola,
/// scaled to the deviation of one value: the centre's weight is 17/35         [Savitzky, Golay].
double parabola_residual(const std::array<double, 5>& y) {
  const double fitted = (-3.0 * y[0] + 12.0 * y[1] + 17.0 * y[2] + 12.0 * y[3] - 3.0 * y[4]) / 35.0;
  return (y[2] - fitted) / std::sqrt(18.0 / 35.0);
}

std::vector<double> residuals_of(const std::vector<TimedValue>& courses) {
  std::vector<double> residuals;
  for (std::size_t i = 2; i + 2 < courses.size(); ++i) {
    std::array<double, 5> y{};
    bool together = true;
    for (std::size_t k = 0; k < 5; ++k) {
      y[k] = courses[i + k - 2].value;
      together &= k == 0 || courses[i + k - 2].time_s - courses[i + k - 3].time_s <= kLongestGap;
    }
    if (together) residuals.push_back(std::abs(parabola_residual(y)));
  }
  return residuals;
}

double median_spacing(const std::vector<TimedValue>& samples) {
  std::vector<double> spacings;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    spacings.push_back(samples[i].time_s - samples[i - 1].time_s);
  }
  return percentile(std::move(spacings), 50.0);
}

/// Turn about Z between two times by the trapezium rule [rad]; empty when samples do not cover it.
std::optional<double> gyro_turn(const VehicleReference& vehicle, double t0, double t1) {
  constexpr double kGyroGap = 0.2;  // [s] twice the spacing of a 10 Hz gyroscope
  double turn = 0.0;
  const ImuSample* before = nullptr;
  for (const ImuSample& sample : vehicle.imu) {
    if (!sample.angular_rate) continue;
    if (before != nullptr && sample.time_s > t0) {
      if (sample.time_s - before->time_s > kGyroGap) return std::nullopt;
      const double from = std::max(t0, before->time_s);
      const double to = std::min(t1, sample.time_s);
      turn += 0.5 * (before->angular_rate->z() + sample.angular_rate->z()) * (to - from);
    } else if (before == nullptr && sample.time_s > t0) {
      return std::nullopt;
    }
    before = &sample;
    if (sample.time_s >= t1) return turn;
  }
  return std::nullopt;
}

}  // namespace

std::optional<GpsQuality> gps_quality(const VehicleReference& vehicle, double spacing_s) {
  const std::vector<TimedValue> courses = driving_courses(vehicle);
  const std::vector<double> residuals = residuals_of(courses);
  if (residuals.empty()) return std::nullopt;
  GpsQuality quality;
  quality.courses = residuals.size();
  // 1.4826: from the median of absolute values to the deviation of a normal distribution.
  quality.course_sigma = 1.4826 * percentile(residuals, 50.0);
  // Two courses span the turn; of one interval the images see their share.
  const double share = std::min(1.0, spacing_s / median_spacing(courses));
  quality.heading_sigma = std::sqrt(2.0) * quality.course_sigma * share;
  return quality;
}

std::optional<double> gps_against_gyro(const VehicleReference& vehicle,
                                       const std::vector<ImageMoment>& images) {
  std::vector<double> differences, seconds;
  for (std::size_t i = 1; i < images.size(); ++i) {
    const double t0 = images[i - 1].time_s, t1 = images[i].time_s;
    const auto gps = vehicle.heading_change(t0, t1);
    const auto gyro = gps ? gyro_turn(vehicle, t0, t1) : std::nullopt;
    if (!gyro || !(t1 > t0)) continue;
    differences.push_back(*gps - *gyro);
    seconds.push_back(t1 - t0);
  }
  if (differences.empty()) return std::nullopt;
  std::vector<double> rates;
  for (std::size_t i = 0; i < differences.size(); ++i) rates.push_back(differences[i] / seconds[i]);
  const double bias = percentile(rates, 50.0);
  double sum = 0.0;
  for (std::size_t i = 0; i < differences.size(); ++i) {
    sum += std::pow(differences[i] - bias * seconds[i], 2);
  }
  return std::sqrt(sum / static_cast<double>(differences.size()));
}

}  // namespace oneac
