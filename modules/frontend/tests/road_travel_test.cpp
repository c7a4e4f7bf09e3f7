#include "scale/road_travel.h"

#include "scale/scale.h"
#include "texture.h"

#include "oneac/frontend/front_end_options.h"
#include "oneac/geometry/angles.h"
#include "oneac/geometry/levelling.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

constexpr double kHeight = 1.5;

PinholeCamera camera() {
  PinholeCamera camera;
  camera.width = 640;
  camera.height = 360;
  camera.fx = camera.fy = 500.0;
  camera.cx = 320.0;
  camera.cy = 130.0;
  return camera;
}

enum class Road { kAsphalt, kSlabs };

/// The road below a level camera at this place [m]; slabs of 0.6 m.
GreyImage view_from(const Eigen::Vector3d& place, Road road = Road::kAsphalt) {
  static const Texture kTexture(3);
  const auto on_slab = [](double x) { return x - 0.6 * std::floor(x / 0.6); };
  GreyImage image(camera().width, camera().height, 180);
  SceneGenerator random(static_cast<int>(1000.0 * place.norm()) + 7);
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      const Eigen::Vector3d ray = camera().normalise(Eigen::Vector2d(u, v)).homogeneous();
      if (!(ray.y() > 0.01)) continue;
      const Eigen::Vector3d X = place + ray * (kHeight / ray.y());
      double grey = 42.0 + 0.4 * kTexture(100.0 * X.x(), 100.0 * X.z());
      if (road == Road::kSlabs) {
        grey = 42.0 + 0.4 * kTexture(100.0 * on_slab(X.x()), 100.0 * on_slab(X.z()));
      }
      image.row(v)[u] =
          static_cast<std::uint8_t>(std::clamp(std::lround(grey + random.normal(1.0)), 0L, 255L));
    }
  }
  return image;
}

/// What the road says of a step by `way` [m] that two views saw in the direction `seen`.
std::optional<MeasuredTravel> told(const Eigen::Vector3d& way, const Eigen::Vector3d& seen,
                                   StepStatus status = StepStatus::kOk,
                                   const std::optional<ExpectedLength>& expected = {}) {
  const GreyImage first = view_from(Eigen::Vector3d::Zero()), second = view_from(way);
  const RoadPair road{RoadImage(first.view()), RoadImage(second.view()), camera(), {}};
  TwoView step;
  step.status = status;
  step.focal_px = camera().focal_px();
  if (status == StepStatus::kOk) step.pose.t = -seen.normalized();
  step.covariance.diagonal().setConstant(1e-6);
  return road_travel(road, step, {{}, -seen.normalized(), expected, 0.1, kHeight}).travel;
}

const Eigen::Vector3d kAhead(0.0, 0.0, 1.0), kAside(1.0, 0.0, 0.0);

TEST(RoadTravel, TellsTheLengthOfAStepAhead) {
  const auto travel = told(0.9 * kAhead, kAhead);
  ASSERT_TRUE(travel.has_value());
  EXPECT_NEAR(travel->length, 0.9, 3.0 * travel->sigma);
  EXPECT_TRUE(travel->in_metres);
}

TEST(RoadTravel, SaysThatARoadOfSlabsRepeats) {
  const auto by = [](Road road) {
    const GreyImage first = view_from(Eigen::Vector3d::Zero(), road);
    const GreyImage second = view_from(0.9 * kAhead, road);
    TwoView step;
    step.status = StepStatus::kOk;
    step.focal_px = camera().focal_px();
    step.pose.t = -kAhead;
    step.covariance.diagonal().setConstant(1e-6);
    return road_travel({RoadImage(first.view()), RoadImage(second.view()), camera(), {}}, step,
                       {{}, -kAhead, {}, 0.1, kHeight});
  };
  EXPECT_TRUE(by(Road::kSlabs).repeats);
  EXPECT_FALSE(by(Road::kSlabs).travel.has_value());
  EXPECT_FALSE(by(Road::kAsphalt).repeats);
}

TEST(RoadTravel, OfARoadThatRepeatedAMomentAgoIsNotBelievedAtOnce) {
  FrontEndOptions options;
  options.camera_height = kHeight;
  Scale scale(options);
  scale.start({});
  TwoView step;
  step.status = StepStatus::kOk;
  step.focal_px = camera().focal_px();
  step.pose.t = -kAhead;
  step.covariance.diagonal().setConstant(1e-6);
  double time_s = 0.0;
  const auto look = [&](Road road) {
    const GreyImage first = view_from(Eigen::Vector3d::Zero(), road);
    const GreyImage second = view_from(0.9 * kAhead, road);
    StepInTime in_time;
    in_time.status = step.status;
    in_time.begin_s = time_s;
    in_time.end_s = time_s += 0.1;
    return scale.measure_directly({RoadImage(first.view()), RoadImage(second.view()), camera(), {}},
                                  step, {}, {}, -kAhead, in_time);
  };
  EXPECT_TRUE(look(Road::kAsphalt).has_value());
  EXPECT_FALSE(look(Road::kSlabs).has_value());
  int withheld = 0;
  while (withheld < 20 && !look(Road::kAsphalt)) ++withheld;
  EXPECT_EQ(withheld, 5);
}

TEST(RoadTravel, SaysHowTheCameraLeansAgainstTheRoad) {
  const auto rolls_seen = [](double believed_deg) {
    const GreyImage first = view_from(Eigen::Vector3d::Zero()), second = view_from(0.9 * kAhead);
    const RoadPair road{RoadImage(first.view()), RoadImage(second.view()), camera(), {}};
    TwoView step;
    step.status = StepStatus::kOk;
    step.focal_px = camera().focal_px();
    step.pose.t = -kAhead;
    step.covariance.diagonal().setConstant(1e-6);
    const Levelling level{levelling_rotation({0.0, believed_deg * kDegree}), 0.0, 2.0 * kDegree};
    return road_travel(road, step, {level, -kAhead, {}, 0.1, kHeight}).travel.value().roll_right;
  };
  for (const double believed_deg : {-2.0, 0.0, 2.0}) {
    const AngleBelief seen = rolls_seen(believed_deg);
    EXPECT_GT(seen.sigma, 0.0);
    EXPECT_NEAR(seen.angle, 0.0, std::max(3.0 * seen.sigma, 0.3 * kDegree)) << believed_deg;
    EXPECT_LT(seen.sigma, 1.0 * kDegree);
  }
}

TEST(RoadTravel, TellsNoLengthOfACameraThatLooksAside) {
  EXPECT_FALSE(told(0.9 * kAside, kAside).has_value()) << "beyond a lane it sees no road";
}

TEST(RoadTravel, OfACameraThatLooksAsideTellsARest) {
  const auto rest = told(Eigen::Vector3d::Zero(), kAside, StepStatus::kNoMotion);
  ASSERT_TRUE(rest.has_value());
  EXPECT_LT(rest->length, 3.0 * rest->sigma);
}

TEST(RoadTravel, TellsNoLengthAlongADirectionThatLeavesTheRoad) {
  const ExpectedLength expected{0.9, 0.1, 0.6, 1.2};
  EXPECT_TRUE(told(0.9 * kAhead, kAhead, StepStatus::kOk, expected).has_value());
  const double rise = 8.0 * kDegree;
  const Eigen::Vector3d rising(0.0, -std::sin(rise), std::cos(rise));
  EXPECT_FALSE(told(0.9 * kAhead, rising, StepStatus::kOk, expected).has_value());
}

}  // namespace
}  // namespace oneac
