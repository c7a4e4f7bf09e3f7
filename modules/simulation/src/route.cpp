#include "route.h"

#include "random_numbers.h"

#include <algorithm>
#include <cmath>

namespace oneac::simulation {
namespace {

constexpr double kQuarterTurn = 1.5707963267948966;
constexpr double kStep = 0.05;            // [m] of the path's table
constexpr int kTransitionSteps = 80;      // 4 m to turn the steering wheel
constexpr int kCircleSteps = 266;         // 13.3 m: a radius of 11 m
constexpr double kCorneringLimit = 2.2;   // [m/s²] brisk, comfortable
constexpr double kShortestStreet = 32.0;  // [m] room to reach cruising speed between bends
constexpr double kLongestStreet = 46.0;   // [m]
constexpr double kSightMargin =
    120.0;  // [m] of street beyond the last frame, so that it does not end
constexpr double kStopPosition = 0.5;  // of the street's length

Eigen::Vector2d direction(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

Eigen::Vector2d quarter_turned(const Eigen::Vector2d& p, int quadrant) {
  switch (quadrant & 3) {
    case 0:
      return p;
    case 1:
      return {-p.y(), p.x()};
    case 2:
      return -p;
    default:
      return {p.y(), -p.x()};
  }
}

/// Moves along an arc of constant curvature; chord exact to third order.
Eigen::Vector2d along_arc(const Eigen::Vector2d& from, double heading, double curvature, double s) {
  return from + s * direction(heading + 0.5 * curvature * s);
}

}  // namespace

Eigen::Vector2d Leg::to_world(const Eigen::Vector2d& p) const {
  return start + quarter_turned(p, quadrant);
}

Eigen::Vector2d Leg::to_leg(const Eigen::Vector2d& p_world) const {
  return quarter_turned(p_world - start, -quadrant);
}

Route::Route(const SimulationOptions& options, double duration_s) : cruise_mps_(options.speed_mps) {
  lay(options, duration_s);
  set_speeds(options);
  set_times();
}

void Route::append(int steps, double curvature_from, double curvature_to) {
  for (int i = 0; i < steps; ++i) {
    const double curvature = curvature_from + (curvature_to - curvature_from) * (i + 0.5) / steps;
    const double limit =
        curvature == 0.0 ? cruise_mps_ : std::sqrt(kCorneringLimit / std::abs(curvature));
    nodes_.push_back({end_, end_heading_, curvature, std::min(limit, cruise_mps_), 0.0, 0.0, 0.0});
    end_ = along_arc(end_, end_heading_, curvature, kStep);
    end_heading_ += curvature * kStep;
  }
}

void Route::append_straight(int steps, int quadrant) {
  end_heading_ = kQuarterTurn * quadrant;  // removes what rounding the bend has left
  legs_.push_back({end_, quadrant & 3, steps * kStep});
  append(steps, 0.0, 0.0);
}

void Route::append_bend(int quadrant, int turn) {
  const double curvature = turn * kQuarterTurn / (kStep * (kCircleSteps + kTransitionSteps));
  append(kTransitionSteps, 0.0, curvature);
  append(kCircleSteps, curvature, curvature);
  append(kTransitionSteps, curvature, 0.0);
  end_heading_ = kQuarterTurn * (quadrant + turn);
}

void Route::lay(const SimulationOptions& options, double duration_s) {
  RandomNumbers random(options.seed ^ 0x726f757465ULL);
  const double needed = duration_s * cruise_mps_ + kSightMargin;
  int turn = random.chance(0.5) ? 1 : -1;
  int quadrant = 0;
  while (static_cast<double>(nodes_.size()) * kStep < needed) {
    const int steps = static_cast<int>(random.uniform(kShortestStreet, kLongestStreet) / kStep);
    const std::size_t first = nodes_.size();
    append_straight(steps, quadrant);
    if (legs_.size() % 2 == 0) {
      nodes_[first + static_cast<std::size_t>(kStopPosition * steps)].wait_s = options.stop_s;
    }
    append_bend(quadrant, turn);
    quadrant += turn;
    turn = -turn;
  }
}

void Route::set_speeds(const SimulationOptions& options) {
  for (Node& node : nodes_) node.speed = node.wait_s > 0.0 ? 0.0 : node.speed_limit;
  const auto reachable = [](double speed, double rate) {
    return std::sqrt(speed * speed + 2.0 * rate * kStep);
  };
  for (std::size_t i = 1; i < nodes_.size(); ++i) {
    nodes_[i].speed =
        std::min(nodes_[i].speed, reachable(nodes_[i - 1].speed, options.acceleration_mps2));
  }
  for (std::size_t i = nodes_.size() - 1; i-- > 0;) {
    nodes_[i].speed =
        std::min(nodes_[i].speed, reachable(nodes_[i + 1].speed, options.braking_mps2));
  }
}

void Route::set_times() {
  nodes_.front().time_s = 0.0;
  for (std::size_t i = 1; i < nodes_.size(); ++i) {
    const Node& before = nodes_[i - 1];
    const double step_s = 2.0 * kStep / (before.speed + nodes_[i].speed);
    nodes_[i].time_s = before.time_s + before.wait_s + step_s;
  }
}

PlanarState Route::at(double time_s) const {
  const auto after = std::upper_bound(nodes_.begin() + 1, nodes_.end() - 1, time_s,
                                      [](double t, const Node& node) { return t < node.time_s; });
  const Node& node = *(after - 1);
  const double moving_s = time_s - node.time_s - node.wait_s;
  PlanarState state{node.position, node.heading, node.curvature, node.speed, 0.0};
  if (moving_s <= 0.0) return state;
  state.acceleration = (after->speed * after->speed - node.speed * node.speed) / (2.0 * kStep);
  const double s = moving_s * (node.speed + 0.5 * state.acceleration * moving_s);
  state.position = along_arc(node.position, node.heading, node.curvature, s);
  state.heading += node.curvature * s;
  state.speed += state.acceleration * moving_s;
  return state;
}

std::vector<Eigen::Vector2d> Route::path() const {
  constexpr std::size_t kStride = 20;  // one metre
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < nodes_.size(); i += kStride) points.push_back(nodes_[i].position);
  return points;
}

}  // namespace oneac::simulation
