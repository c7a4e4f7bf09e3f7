#include "oneac/simulation/laps.h"

#include "route.h"

#include "oneac/base/require.h"
#include "oneac/geometry/angles.h"

#include <cmath>
#include <optional>
#include <stdexcept>

namespace oneac {
namespace {

constexpr double kSamePlace_m = 3.0;               // what place recognition is asked to find
constexpr double kSameDirection = 15.0 * kDegree;  // the same
constexpr double kDrivenBetween_m = 30.0;          // more than a frame's neighbours
constexpr int kMostLaps = 1000;                    // far beyond the frames that a drive may have

struct Station {
  Eigen::Isometry3d T_world_cam;
  double driven_m = 0.0;
};

std::vector<Station> stations_of(const StreetSimulator& simulator) {
  std::vector<Station> stations;
  for (std::size_t i = 0; i < simulator.size(); ++i) {
    Station station{simulator.state(i).T_world_cam, 0.0};
    if (i > 0) {
      const Station& before = stations.back();
      station.driven_m =
          before.driven_m +
          (station.T_world_cam.translation() - before.T_world_cam.translation()).norm();
    }
    stations.push_back(station);
  }
  return stations;
}

bool same_direction(const Station& a, const Station& b) {
  const Eigen::Matrix3d R = a.T_world_cam.linear().transpose() * b.T_world_cam.linear();
  return Eigen::AngleAxisd(R).angle() < kSameDirection;
}

/// The nearest station that station i sees again.
std::optional<std::size_t> seen_before(const std::vector<Station>& stations, std::size_t i) {
  const Station& now = stations[i];
  std::optional<std::size_t> nearest;
  double least = kSamePlace_m;
  for (std::size_t k = 0; k < i; ++k) {
    const Station& then = stations[k];
    if (now.driven_m - then.driven_m <= kDrivenBetween_m) break;
    const double apart = (now.T_world_cam.translation() - then.T_world_cam.translation()).norm();
    if (apart >= least || !same_direction(now, then)) continue;
    least = apart;
    nearest = k;
  }
  return nearest;
}

}  // namespace

int frames_for_laps(const SimulationOptions& options, int laps) {
  options.validate();
  require(laps >= 1 && laps <= kMostLaps, "frames_for_laps: laps", laps, "within 1 ... 1000");
  if (!has_laps(options.route)) {
    throw std::invalid_argument("frames_for_laps: SimulationOptions.route has no laps");
  }
  const double streets = options.route == RouteKind::kBlock ? 4.0 : 8.0;
  const double lap_s = streets * options.block_m / options.speed_mps;
  const simulation::Route route(options, (laps + 1) * lap_s);
  return 1 + static_cast<int>(std::floor(route.lap_start_s(laps) * options.fps));
}

std::vector<TrueLoop> true_loops(const StreetSimulator& simulator) {
  const std::vector<Station> stations = stations_of(simulator);
  std::vector<TrueLoop> loops;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const auto k = seen_before(stations, i);
    if (!k) continue;
    loops.push_back({*k, i, stations[i].T_world_cam.inverse() * stations[*k].T_world_cam});
  }
  return loops;
}

}  // namespace oneac
