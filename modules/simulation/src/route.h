#pragma once

#include "oneac/simulation/simulation_options.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace oneac::simulation {

/// A straight street. Its frame: x along the direction of travel, y to the left, origin where it
/// starts; streets run along the axes of the world.
struct Leg {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();
  int quadrant = 0;  ///< heading in quarter turns
  double length_m = 0.0;

  [[nodiscard]] Eigen::Vector2d to_world(const Eigen::Vector2d& p) const;
  [[nodiscard]] Eigen::Vector2d to_leg(const Eigen::Vector2d& p_world) const;
};

/// The vehicle's planar motion at one instant.
struct PlanarState {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< [m]
  double heading = 0.0;                                ///< from X, positive to the left [rad]
  double curvature = 0.0;                              ///< positive to the left [1/m]
  double speed = 0.0;                                  ///< [m/s]
  double acceleration = 0.0;                           ///< along the path [m/s²]
};

/// Where and when the vehicle stands.
struct Stop {
  Leg leg;
  double x = 0.0;       ///< along the leg [m]
  double time_s = 0.0;  ///< of arrival
  double wait_s = 0.0;
};

/// Where the vehicle drives and when: straights and quarter-circle bends with transition curves,
/// left and right in turn (so that the route never meets itself), speed limited by cornering,
/// acceleration, braking and stops; or another RouteKind.
class Route {
 public:
  /// Long enough for a drive of the given duration and some way beyond.
  Route(const SimulationOptions& options, double duration_s);

  [[nodiscard]] PlanarState at(double time_s) const;
  [[nodiscard]] const std::vector<Leg>& legs() const { return legs_; }
  [[nodiscard]] double cruise_mps() const { return cruise_mps_; }
  [[nodiscard]] std::vector<Stop> stops() const;
  /// When a lap begins [s]; lap 0 at 0. @pre the route is long enough for it
  [[nodiscard]] double lap_start_s(int lap) const;
  /// The lap at a time, from 0; 0 on a route without.
  [[nodiscard]] int lap_at(double time_s) const;
  /// Points of the path, about a metre apart; of the first two laps, as the others repeat them.
  [[nodiscard]] std::vector<Eigen::Vector2d> path() const;

 private:
  struct Node {  ///< one step of the path; curvature and acceleration hold until the next
    Eigen::Vector2d position;
    double heading;
    double curvature;
    double speed_limit;
    double wait_s;  ///< standing time here
    double speed;
    double time_s;  ///< of arrival
  };

  void append(int steps, double curvature_from, double curvature_to);
  void append_straight(int steps, int quadrant);
  void append_bend(int quadrant, int turn);
  void append_roundabout(int quadrant, int turn);
  void wait_at(std::size_t node, double wait_s);
  void lay(const SimulationOptions& options, double needed_m);
  void lay_streets(const SimulationOptions& options, double needed_m);
  void lay_straight(const SimulationOptions& options, double needed_m);
  void lay_roundabouts(const SimulationOptions& options, double needed_m);
  void lay_block(const SimulationOptions& options, double needed_m);
  void lay_figure8(const SimulationOptions& options, double needed_m);
  void append_lap(int side_steps, int shift_before, int shift, int shift_after);
  void append_figure8(int side_steps, int across_steps);
  [[nodiscard]] double bend_extent();
  void set_speeds(const SimulationOptions& options);
  void set_times();

  struct Halt {
    std::size_t leg;
    std::size_t node;
    double x;
  };

  std::vector<Leg> legs_;
  std::vector<Halt> halts_;
  std::vector<Node> nodes_;
  std::vector<std::size_t> lap_starts_;  ///< nodes
  Eigen::Vector2d end_ = Eigen::Vector2d::Zero();
  double end_heading_ = 0.0;
  double cruise_mps_ = 0.0;
};

}  // namespace oneac::simulation
