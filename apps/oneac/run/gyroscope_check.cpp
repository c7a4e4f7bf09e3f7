#include "gyroscope_check.h"

#include "vehicle_turns.h"

#include "oneac/base/number_text.h"
#include "oneac/geometry/angles.h"

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>

namespace oneac::app {
namespace {

constexpr double kWindow_s = 2.0, kGrid_s = 0.2;
constexpr std::size_t kFewest = 25;      // windows: 5 s
constexpr double kBend = 3.0 * kDegree;  // 1σ of the turns in windows
constexpr double kFollows = 0.8;  // correlation of a sensor that may be late by half a second
constexpr double kIsIt = 0.9;     // of an axis that is named
constexpr double kStrange = 0.5;  // and of one that has nothing to do with the images
constexpr double kFactor = 2.0;   // beyond, no bad camera explains it

/// By images, then about the axes X, Y, Z of the gyroscope [rad].
using Turns = Eigen::Array4d;

Heading heading_by_images(const Trajectory& vehicle, const std::vector<bool>& carried) {
  constexpr double kLongestGap_s = 1.0;
  Heading heading(kLongestGap_s);
  for (std::size_t i = 0; i < vehicle.poses.size(); ++i) {
    heading.turn_by(vehicle.times[i], turn_about_upright(vehicle, i), i > 0 && carried[i]);
  }
  return heading;
}

std::vector<Turns> turns_in_windows(const Trajectory& vehicle, const std::vector<bool>& carried,
                                    const std::vector<ImuSample>& imu) {
  const Heading images = heading_by_images(vehicle, carried);
  std::array<GyroscopeHeading, 3> axes{heading_by_gyroscope(imu, 0), heading_by_gyroscope(imu, 1),
                                       heading_by_gyroscope(imu, 2)};
  std::vector<Turns> turns;
  if (vehicle.times.empty() || axes.front().heading().empty()) return turns;
  // From image to image: stamps may jump by years.
  double next = vehicle.times.front();
  for (const double t : vehicle.times) {
    if (t < next) continue;
    next = t + kGrid_s;
    const std::array<std::optional<double>, 4> seen{
        images.turn(t, t + kWindow_s), axes[0].heading().turn(t, t + kWindow_s),
        axes[1].heading().turn(t, t + kWindow_s), axes[2].heading().turn(t, t + kWindow_s)};
    // The axes have their samples together.
    if (seen[0] && seen[1]) turns.emplace_back(*seen[0], *seen[1], *seen[2], *seen[3]);
  }
  return turns;
}

/// How one axis goes with the images.
struct Follows {
  double correlation = 0.0, times = 0.0;
};

Follows follows(const Eigen::ArrayX4d& centred, int axis) {
  const double images = centred.col(0).square().sum();
  const double both = (centred.col(0) * centred.col(axis + 1)).sum();
  const double alone = centred.col(axis + 1).square().sum();
  if (!(images > 0.0) || !(alone > 0.0)) return {};
  return {both / std::sqrt(images * alone), both / images};
}

/// Without their means: that is where a bias goes.
Eigen::ArrayX4d centred(const std::vector<Turns>& turns) {
  Eigen::ArrayX4d rows(static_cast<Eigen::Index>(turns.size()), 4);
  for (std::size_t i = 0; i < turns.size(); ++i) {
    rows.row(static_cast<Eigen::Index>(i)) = turns[i].transpose();
  }
  return rows.rowwise() - rows.colwise().mean();
}

bool is_near(double times, double wanted) {
  constexpr double kWithin = 1.3;  // a focal length that is off by as much
  return times > wanted / kWithin && times < wanted * kWithin;
}

}  // namespace

std::optional<GyroscopeFault> fault_of_gyroscope(const Trajectory& vehicle,
                                                 const std::vector<bool>& carried,
                                                 const std::vector<ImuSample>& imu) {
  const std::vector<Turns> turns = turns_in_windows(vehicle, carried, imu);
  if (turns.size() < kFewest) return std::nullopt;
  const Eigen::ArrayX4d rows = centred(turns);
  if (std::sqrt(rows.col(0).square().mean()) < kBend) return std::nullopt;
  const Follows upright = follows(rows, 2);
  const bool same = upright.times > 1.0 / kFactor && upright.times < kFactor;
  if (same && upright.correlation >= kFollows) return std::nullopt;
  GyroscopeFault fault;
  double best = kIsIt;
  for (const int axis : {2, 0, 1}) {
    const Follows one = follows(rows, axis);
    if (!(std::abs(one.correlation) > best)) continue;
    best = std::abs(one.correlation);
    fault = {axis, one.times};
  }
  const bool strange = std::abs(upright.correlation) < kStrange;
  return fault.axis >= 0 || strange ? std::optional(fault) : std::nullopt;
}

std::string about_gyroscope(const GyroscopeFault& fault) {
  constexpr double kDegrees = 180.0 / M_PI;
  std::string how = "no axis of it does";
  if (fault.axis >= 0) {
    const double times = std::abs(fault.times);
    how = std::string("they turn as it does about its ") + (fault.times < 0.0 ? "-" : "+") +
          "XYZ"[fault.axis] + " axis";
    if (is_near(times, kDegrees)) {
      how += " in deg/s";
    } else if (is_near(times, 1.0 / kDegrees)) {
      how += ", turned from degrees into radians once too often";
    } else if (!is_near(times, 1.0)) {
      how += ", " + significant_text(times, 2) + " times as much";
    }
  }
  return "the gyroscope does not turn with the images: " + how +
         "; it must tell rad/s of the vehicle's axes (X ahead, Y left, Z up), at the images' time: "
         "correct it in the log, what is made of its turns is wrong";
}

}  // namespace oneac::app
