#include "street_layout.h"

#include "random_numbers.h"

#include <algorithm>
#include <cmath>

namespace oneac::simulation {
namespace {

constexpr double kOverrun = 32.0;  // [m] rows run beyond a street, to close the next one's view
constexpr double kBuildingClearance = 4.6;  // [m] from the path
constexpr double kObstacleClearance = 2.3;  // [m] from the path: half a vehicle and some air
constexpr double kBuildingDepth = 9.0;      // [m]
constexpr double kAlleyChance = 0.12;       // between two buildings
constexpr double kRetryStep = 0.8;          // [m] how finely a free place is looked for
constexpr std::uint64_t kBuildings = 0x7374726565ULL;  // what keeps random streams apart
constexpr std::uint64_t kKerbs = 0x6b65726273ULL;      // of streets that are alike
constexpr std::uint64_t kOtherKerbs = 0x6f74686572ULL;

class StreetBuilder {
 public:
  StreetBuilder(const Route& route, const TownPlan& plan)
      : random_(plan.seed ^ kBuildings), alike_(plan.alike), path_(route.path()) {
    for (const Leg& leg : route.legs()) {
      for (int side : {-1, 1}) add_buildings(leg, side);
    }
    const std::uint64_t kerbs = plan.seed ^ (plan.other_vehicles ? kOtherKerbs : kKerbs);
    if (alike_ || plan.other_vehicles) random_ = RandomNumbers(kerbs);
    for (const Leg& leg : route.legs()) {
      if (alike_) random_ = RandomNumbers(kerbs);
      for (int side : {-1, 1}) add_obstacles(leg, side);
    }
  }
  std::vector<Box> take() { return std::move(boxes_); }

 private:
  void add_buildings(const Leg& leg, int side) {
    double x = -kOverrun;
    while (x < leg.length_m + kOverrun) {
      const double length = within(7.0, 15.0);
      const double setback = side < 0 ? within(6.0, 7.8) : within(9.2, 11.5);
      const double height = within(4.5, 13.0);
      const double y = side * setback;
      const Box box = placed(leg, {x, y}, {x + length, y + side * kBuildingDepth}, height);
      if (!is_free(box, kBuildingClearance)) {
        x += kRetryStep;
        continue;
      }
      boxes_.push_back(box);
      x += length + (!alike_ && random_.chance(kAlleyChance) ? random_.uniform(2.0, 3.5) : 0.0);
    }
  }

  /// Where buildings are alike, the middle.
  [[nodiscard]] double within(double low, double high) {
    return alike_ ? 0.5 * (low + high) : random_.uniform(low, high);
  }

  void add_obstacles(const Leg& leg, double side) {
    const double kerb = side < 0 ? -2.5 : 6.3;
    double x = random_.uniform(0.0, 6.0);
    while (x < leg.length_m) {
      if (random_.chance(0.6)) {
        add_obstacle(leg, {x, kerb, side},
                     {random_.uniform(3.6, 4.8), 1.8, random_.uniform(1.3, 2.1)},
                     Box::Kind::kVehicle);
      } else if (random_.chance(0.5)) {
        add_obstacle(leg, {x, kerb + side * 1.0, side}, {1.1, 1.0, random_.uniform(1.0, 1.4)},
                     Box::Kind::kVehicle);
      } else {
        add_obstacle(leg, {x, kerb + side * 0.8, side}, {0.25, 0.25, random_.uniform(2.2, 4.5)},
                     Box::Kind::kPost);
      }
      x += random_.uniform(5.0, 13.0);
    }
  }

  /// @param foot  x, y of the edge towards the road, side  @param size  along, across, up
  void add_obstacle(const Leg& leg, const Eigen::Vector3d& foot, const Eigen::Vector3d& size,
                    Box::Kind kind) {
    const Eigen::Vector2d across(size.x(), foot.z() * size.y());
    Box box = placed(leg, foot.head<2>(), foot.head<2>() + across, size.z());
    box.kind = kind;
    if (is_free(box, kObstacleClearance)) boxes_.push_back(box);
  }

  static Box placed(const Leg& leg, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                    double height) {
    const Eigen::Vector2d a = leg.to_world(from);
    const Eigen::Vector2d b = leg.to_world(to);
    Box box;
    box.low << a.cwiseMin(b), 0.0;
    box.high << a.cwiseMax(b), height;
    return box;
  }

  [[nodiscard]] bool is_free(const Box& box, double clearance) const {
    const Eigen::Vector2d low = box.low.head<2>();
    const Eigen::Vector2d high = box.high.head<2>();
    const auto too_near = [&](const Eigen::Vector2d& p) {
      return (p - p.cwiseMax(low).cwiseMin(high)).squaredNorm() < clearance * clearance;
    };
    const auto overlaps = [&](const Box& other) {
      return (other.low.head<2>().array() < high.array()).all() &&
             (other.high.head<2>().array() > low.array()).all();
    };
    return std::none_of(path_.begin(), path_.end(), too_near) &&
           std::none_of(boxes_.begin(), boxes_.end(), overlaps);
  }

  RandomNumbers random_;
  bool alike_;
  std::vector<Eigen::Vector2d> path_;
  std::vector<Box> boxes_;
};

}  // namespace

std::vector<Box> lay_out_street(const Route& route, const TownPlan& plan) {
  return StreetBuilder(route, plan).take();
}

}  // namespace oneac::simulation
