#include "random_numbers.h"
#include "street_layout.h"

#include <algorithm>
#include <cmath>

namespace oneac::simulation {
namespace {

constexpr double kNearest_m = 110.0;   // of the houses
constexpr double kReach_m = 320.0;     // how far from the road they are strewn
constexpr int kHousesPer100m = 30;     // of the route: the horizon is nearly closed
constexpr double kPostBeside_m = 2.6;  // right of the lane

bool near_path(const std::vector<Eigen::Vector2d>& path, const Box& box, double distance) {
  const Eigen::Vector2d low = box.low.head<2>();
  const Eigen::Vector2d high = box.high.head<2>();
  return std::any_of(path.begin(), path.end(), [&](const Eigen::Vector2d& p) {
    return (p - p.cwiseMax(low).cwiseMin(high)).squaredNorm() < distance * distance;
  });
}

Box block(const Eigen::Vector2d& centre, const Eigen::Vector3d& size, Box::Kind kind) {
  Box box;
  box.kind = kind;
  box.low << centre - 0.5 * size.head<2>(), 0.0;
  box.high << centre + 0.5 * size.head<2>(), size.z();
  return box;
}

Eigen::Vector2d around(RandomNumbers& random, const Eigen::Vector2d& centre) {
  const double angle = random.uniform(0.0, 6.283185307179586);
  const double distance = random.uniform(kNearest_m, kReach_m);
  return centre + distance * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

void add_houses(RandomNumbers& random, const std::vector<Eigen::Vector2d>& path,
                std::vector<Box>& boxes) {
  const int last = static_cast<int>(path.size()) - 1;
  for (int i = kHousesPer100m * (1 + last / 100); i > 0; --i) {
    const Eigen::Vector2d& from = path[static_cast<std::size_t>(random.integer(0, last))];
    const Eigen::Vector2d centre = around(random, from);
    const double length = random.uniform(12.0, 38.0);
    const double depth = random.uniform(10.0, 20.0);
    const Box house =
        block(centre, {length, depth, random.uniform(5.0, 24.0)}, Box::Kind::kFarBuilding);
    if (!near_path(path, house, kNearest_m)) boxes.push_back(house);
  }
}

void add_posts(RandomNumbers& random, const Leg& leg, const std::vector<Eigen::Vector2d>& path,
               std::vector<Box>& boxes) {
  double x = random.uniform(5.0, 25.0);
  while (x < leg.length_m) {
    const double height = random.uniform(4.5, 7.0);
    const Box post =
        block(leg.to_world({x, -kPostBeside_m}), {0.22, 0.22, height}, Box::Kind::kPost);
    if (!near_path(path, post, 2.3)) boxes.push_back(post);
    x += random.uniform(25.0, 45.0);
  }
}

}  // namespace

std::vector<Box> lay_out_open_land(const Route& route, std::uint64_t seed) {
  RandomNumbers random(seed ^ 0x6f70656eULL);
  const std::vector<Eigen::Vector2d> path = route.path();
  std::vector<Box> boxes;
  add_houses(random, path, boxes);
  for (const Leg& leg : route.legs()) add_posts(random, leg, path, boxes);
  return boxes;
}

}  // namespace oneac::simulation
