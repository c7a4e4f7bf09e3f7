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
constexpr double kStopPosition = 0.5;                     // of the street's length
constexpr double kStopAlone = 30.0;                       // [m] from where a straight route begins
constexpr double kEntryAngle = kQuarterTurn * 2.0 / 3.0;  // aside, at a roundabout
constexpr double kEntryRadius = 10.0;                     // [m]
constexpr double kRoundaboutRadius = 14.0;                // [m] of the lane
constexpr double kShortestGo = 10.0;                      // [m] between two stops of a queue
constexpr double kLongestGo = 22.0;                       // [m]
constexpr double kShortestWait = 1.0;                     // [s] of a stop in a queue
constexpr double kLongestWait = 3.5;                      // [s]

constexpr std::size_t kLapsOfTheTown = 2;  // what is built must not depend on how long one drives

int in_steps(double length) {
  return static_cast<int>(std::lround(length / kStep));
}

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
  lay(options, duration_s * cruise_mps_ + kSightMargin);
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

/// Right into it, round it to the left, right out of it: 30 degrees each way before the circle
/// proper; as a whole a quarter turn to the left or straight on.
void Route::append_roundabout(int quadrant, int turn) {
  const auto arc = [this](double angle, double radius) {
    const double share =
        kTransitionSteps * kStep / radius;  // half of it is lost in each transition
    const int steps = static_cast<int>((std::abs(angle) - share) * radius / kStep);
    const double curvature = angle / (kStep * (steps + kTransitionSteps));
    append(kTransitionSteps, 0.0, curvature);
    append(steps, curvature, curvature);
    append(kTransitionSteps, curvature, 0.0);
  };
  arc(-kEntryAngle, kEntryRadius);
  arc(2.0 * kEntryAngle + turn * kQuarterTurn, kRoundaboutRadius);
  arc(-kEntryAngle, kEntryRadius);
  end_heading_ = kQuarterTurn * (quadrant + turn);
}

void Route::wait_at(std::size_t node, double wait_s) {
  nodes_[node].wait_s = wait_s;
  const Leg& leg = legs_.back();
  halts_.push_back({legs_.size() - 1, node, leg.to_leg(nodes_[node].position).x()});
}

void Route::lay(const SimulationOptions& options, double needed_m) {
  switch (options.route) {
    case RouteKind::kStreet:
      return lay_streets(options, needed_m);
    case RouteKind::kRoundabout:
      return lay_roundabouts(options, needed_m);
    case RouteKind::kBlock:
      return lay_block(options, needed_m);
    case RouteKind::kFigure8:
      return lay_figure8(options, needed_m);
    default:
      return lay_straight(options, needed_m);
  }
}

void Route::lay_streets(const SimulationOptions& options, double needed_m) {
  RandomNumbers random(options.seed ^ 0x726f757465ULL);
  int turn = random.chance(0.5) ? 1 : -1;
  int quadrant = 0;
  while (static_cast<double>(nodes_.size()) * kStep < needed_m) {
    const int steps = static_cast<int>(random.uniform(kShortestStreet, kLongestStreet) / kStep);
    const std::size_t first = nodes_.size();
    append_straight(steps, quadrant);
    if (legs_.size() % 2 == 0) {
      wait_at(first + static_cast<std::size_t>(kStopPosition * steps), options.stop_s);
    }
    append_bend(quadrant, turn);
    quadrant += turn;
    turn = -turn;
  }
}

void Route::lay_straight(const SimulationOptions& options, double needed_m) {
  append_straight(static_cast<int>(needed_m / kStep), 0);
  if (options.route == RouteKind::kStraight) {
    wait_at(static_cast<std::size_t>(kStopAlone / kStep), options.stop_s);
    return;
  }
  RandomNumbers random(options.seed ^ 0x73746f70ULL);
  double x = random.uniform(kShortestGo, kLongestGo);
  while (x < needed_m - kSightMargin) {
    wait_at(static_cast<std::size_t>(x / kStep), random.uniform(kShortestWait, kLongestWait));
    x += random.uniform(kShortestGo, kLongestGo);
  }
}

void Route::lay_roundabouts(const SimulationOptions& options, double needed_m) {
  RandomNumbers random(options.seed ^ 0x726f756eULL);
  int quadrant = 0;
  int turn = 1;
  while (static_cast<double>(nodes_.size()) * kStep < needed_m) {
    append_straight(static_cast<int>(random.uniform(kShortestStreet, kLongestStreet) / kStep),
                    quadrant);
    append_roundabout(quadrant, turn);
    quadrant += turn;
    turn = 1 - turn;  // to the left, straight on, to the left ...
  }
}

/// How far before and beyond the corner of two streets their bend reaches [m]. Lays nothing.
double Route::bend_extent() {
  append_bend(0, 1);
  const double extent = end_.x();
  nodes_.clear();
  end_.setZero();
  end_heading_ = 0.0;
  return extent;
}

/// Four streets and bends. Shifts are those of the lap before, this one and the next: a lap that is
/// shifted inwards drives a smaller square, and starts where the lap before has brought it.
void Route::append_lap(int side_steps, int shift_before, int shift, int shift_after) {
  lap_starts_.push_back(nodes_.size());
  for (int street = 0; street < 4; ++street) {
    const int at_start = street == 0 ? shift_before : shift;
    const int at_end = street == 3 ? shift_after : shift;
    append_straight(side_steps - at_start - at_end, street);
    append_bend(street, 1);
  }
  if (lap_starts_.size() > 1) legs_.resize(4);  // the streets are those of the first lap
}

/// Three streets and left bends, straight over the junction where they began, the same to the
/// right, and straight over it again.
void Route::append_figure8(int side_steps, int across_steps) {
  lap_starts_.push_back(nodes_.size());
  for (int street = 0; street < 3; ++street) {
    append_straight(side_steps, street);
    append_bend(street, 1);
  }
  append_straight(2 * side_steps + across_steps, 3);
  for (int street = 3; street > 0; --street) {
    append_bend(street, -1);
    append_straight(side_steps + (street == 1 ? across_steps : 0), street - 1);
  }
  constexpr std::size_t kStreets = 7;
  if (lap_starts_.size() > 1) legs_.resize(kStreets);  // those of the first lap
}

void Route::lay_figure8(const SimulationOptions& options, double needed_m) {
  const double extent = bend_extent();
  const int side = in_steps(options.block_m - 2.0 * extent), across = in_steps(2.0 * extent);
  while (lap_starts_.size() < kLapsOfTheTown ||
         static_cast<double>(nodes_.size()) * kStep < needed_m) {
    append_figure8(side, across);
  }
}

void Route::lay_block(const SimulationOptions& options, double needed_m) {
  const int side = in_steps(options.block_m - 2.0 * bend_extent());
  const int shift = in_steps(options.lane_shift_m);
  while (lap_starts_.size() < kLapsOfTheTown ||
         static_cast<double>(nodes_.size()) * kStep < needed_m) {
    const std::size_t lap = lap_starts_.size();
    const int own = lap % 2 == 0 ? 0 : shift;
    const int other = lap % 2 == 0 ? shift : 0;
    append_lap(side, lap == 0 ? 0 : other, own, other);
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

double Route::lap_start_s(int lap) const {
  return nodes_[lap_starts_.at(static_cast<std::size_t>(lap))].time_s;
}

int Route::lap_at(double time_s) const {
  const auto later =
      std::upper_bound(lap_starts_.begin(), lap_starts_.end(), time_s,
                       [this](double t, std::size_t node) { return t < nodes_[node].time_s; });
  return std::max(0, static_cast<int>(later - lap_starts_.begin()) - 1);
}

std::vector<Stop> Route::stops() const {
  std::vector<Stop> stops;
  for (const Halt& halt : halts_) {
    const Node& node = nodes_[halt.node];
    if (node.wait_s > 0.0) stops.push_back({legs_[halt.leg], halt.x, node.time_s, node.wait_s});
  }
  return stops;
}

std::vector<Eigen::Vector2d> Route::path() const {
  constexpr std::size_t kStride = 20;  // one metre
  std::vector<Eigen::Vector2d> points;
  const std::size_t end = lap_starts_.size() > 2 ? lap_starts_[2] : nodes_.size();
  for (std::size_t i = 0; i < end; i += kStride) points.push_back(nodes_[i].position);
  return points;
}

}  // namespace oneac::simulation
