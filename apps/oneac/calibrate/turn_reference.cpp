#include "calibrate/turn_reference.h"

#include "oneac/geometry/angles.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace oneac::app {
namespace {

// The vehicle goes straight where it turns by less over a second [rad]: the slip at an antenna a
// metre ahead of the rear axle is 0.25 degrees at 8 m/s then.
constexpr double kStraight = 2.0 * kDegree;
constexpr double kAround = 0.5;     // [s] before and after a moment
constexpr double kLeastSpan = 2.0;  // [s]
// [m/s] below, the course of a GPS is noise.
constexpr double kMoving = 3.0;
// Gyroscopes of phones and cars: scale good to a per cent, turn-on bias of a degree per second. One
// that is sampled at 10 Hz and more turns by 0.1° wrongly in a bend.
constexpr TurnSensor kGyroscope{0.1 * kDegree, 0.01, 1.0 * kDegree};
// A course of Doppler speeds, 0.05 m/s across 8 m/s; it has neither scale nor bias.
constexpr TurnSensor kCourse{0.35 * kDegree, 0.0, 0.0};

/// A heading over time, counter-clockwise, without jumps of a full turn.
class Heading {
 public:
  explicit Heading(double longest_gap) : longest_gap_(longest_gap) {}

  void add(double time, double angle, bool goes_on = true) {
    if (!times_.empty() && !(time > times_.back())) return;
    if (times_.empty() || !goes_on || time - times_.back() > longest_gap_) ++piece_;
    times_.push_back(time);
    angles_.push_back(angle);
    pieces_.push_back(piece_);
  }
  /// How far it turned; empty where it is not known all the way.
  [[nodiscard]] std::optional<double> turn(double begin, double end) const {
    const auto a = at(begin), b = at(end);
    if (!a || !b || a->second != b->second) return std::nullopt;
    return b->first - a->first;
  }
  [[nodiscard]] const std::vector<double>& times() const { return times_; }
  [[nodiscard]] double last() const { return angles_.empty() ? 0.0 : angles_.back(); }

 private:
  /// The angle and the piece without gaps that it is of.
  [[nodiscard]] std::optional<std::pair<double, int>> at(double time) const {
    const auto next = std::upper_bound(times_.begin(), times_.end(), time);
    if (next == times_.begin() || next == times_.end()) return std::nullopt;
    const auto i = static_cast<std::size_t>(next - times_.begin());
    if (pieces_[i] != pieces_[i - 1]) return std::nullopt;
    const double share = (time - times_[i - 1]) / (times_[i] - times_[i - 1]);
    return std::pair(angles_[i - 1] + (angles_[i] - angles_[i - 1]) * share, pieces_[i]);
  }

  double longest_gap_;
  std::vector<double> times_, angles_;
  std::vector<int> pieces_;
  int piece_ = 0;
};

Heading heading_by_images(const DriveRecord& drive) {
  constexpr double kLongestGap = 1.0;  // [s]
  const Trajectory vehicle = drive.vehicle_trajectory();
  Heading heading(kLongestGap);
  for (std::size_t i = 0; i < vehicle.poses.size() && i < drive.frames.size(); ++i) {
    const auto& step = drive.frames[i].step;
    const bool carried = step && step->status != StepStatus::kPredicted;
    double turn = 0.0;
    if (i > 0) {
      const Eigen::Matrix3d R =
          vehicle.poses[i - 1].linear().transpose() * vehicle.poses[i].linear();
      const Eigen::AngleAxisd turned(R);
      turn = turned.angle() * turned.axis().z();
    }
    heading.add(vehicle.times[i], heading.last() + turn, carried);
  }
  return heading;
}

Heading heading_by_gyroscope(const std::vector<ImuSample>& samples) {
  constexpr double kLongestGap = 0.25;  // [s] rates change within
  Heading heading(kLongestGap);
  std::optional<std::pair<double, double>> before;
  for (const ImuSample& sample : samples) {
    if (!sample.angular_rate) continue;
    const double rate = sample.angular_rate->z();
    const double turn =
        before ? 0.5 * (before->second + rate) * (sample.time_s - before->first) : 0;
    heading.add(sample.time_s, heading.last() + turn);
    before = {sample.time_s, rate};
  }
  return heading;
}

/// Stands still in time where the vehicle is slow.
Heading heading_by_course(const std::vector<GpsFix>& fixes) {
  constexpr double kLongestGap = 1.5;  // [s] a receiver of 1 Hz that loses no fix
  Heading heading(kLongestGap);
  bool goes_on = false;
  for (const GpsFix& fix : fixes) {
    const bool moves = fix.course && fix.speed && *fix.speed >= kMoving;
    if (moves) {
      const double last = heading.last();
      heading.add(fix.time_s, last + std::remainder(-*fix.course - last, 2.0 * M_PI), goes_on);
    }
    goes_on = moves || (goes_on && !fix.course);
  }
  return heading;
}

bool is_straight(const Heading& images, double time) {
  const auto turn = images.turn(time - kAround, time + kAround);
  return turn && std::abs(*turn) < kStraight;
}

std::vector<TurnSpan> spans_of(const Heading& images, const Heading& sensor) {
  std::vector<TurnSpan> spans;
  std::optional<double> begin;
  for (const double time : images.times()) {
    if (!is_straight(images, time)) continue;
    if (begin && time - *begin < kLeastSpan) continue;
    if (begin) {
      const auto seen = images.turn(*begin, time), told = sensor.turn(*begin, time);
      if (seen && told) spans.push_back({time - *begin, *seen, *told});
    }
    begin = time;
  }
  return spans;
}

}  // namespace

std::vector<TurnEvidence> turn_evidence(const DriveRecord& drive) {
  const Heading images = heading_by_images(drive);
  const VehicleReference& reference = drive.source.reference;
  std::vector<TurnEvidence> evidence;
  const auto take = [&](const char* name, const Heading& sensor, const TurnSensor& errors) {
    const auto measured = measure_focal_by_turns(spans_of(images, sensor), errors);
    if (measured) evidence.push_back({name, *measured});
  };
  take("gyroscope", heading_by_gyroscope(reference.imu), kGyroscope);
  take("GPS course", heading_by_course(reference.gps), kCourse);
  return evidence;
}

}  // namespace oneac::app
