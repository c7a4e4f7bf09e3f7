#include "oneac/robust/ground_scale.h"

#include "oneac/geometry/levelling.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace oneac {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kSigma = 0.5 / 700.0;
const Eigen::Matrix3d kLevel = Eigen::Matrix3d::Identity();

RelativePose forward(double length) {
  return {yaw_rotation(std::cos(0.02), std::sin(0.02)), {0.05 * length, 0.0, -length}};
}

RelativePose with_unit_length(RelativePose T) {
  T.t.normalize();
  return T;
}

/// Road points a few heights ahead and wall points beside, all of height 1.
std::vector<AffineCorrespondence> road_and_walls(SceneGenerator& scene, const RelativePose& T,
                                                 int road, int wall, double noise) {
  std::vector<AffineCorrespondence> acs;
  const Plane ground{Eigen::Vector3d::UnitY(), 1.0};
  const auto add = [&](const Plane& plane, double low_y, double high_y) {
    const auto H = plane_induced_homography(T, plane);
    for (;;) {
      const Eigen::Vector2d x1 = scene.image_point(low_y, high_y);
      if (plane.d / plane.n.dot(x1.homogeneous()) < 1.5) continue;
      const auto ac = correspondence_from_homography(H, x1);
      if (!ac) continue;
      acs.push_back(scene.with_noise(*ac, noise, 20.0 * noise));
      return;
    }
  };
  for (int i = 0; i < road; ++i) add(ground, 0.12, 0.4);
  for (int i = 0; i < wall; ++i) add({Eigen::Vector3d::UnitX(), 3.0}, -0.3, 0.25);
  return acs;
}

TEST(GroundScale, GivesTheStepInCameraHeights) {
  SceneGenerator scene(31);
  for (double length : {0.3, 0.6, 1.0}) {
    const RelativePose T = forward(length);
    const auto acs = road_and_walls(scene, T, 80, 120, 0.3 * kSigma);
    const auto scale = ground_scale(acs, std::vector<bool>(acs.size(), true), with_unit_length(T),
                                    kLevel, kSigma, {});
    ASSERT_TRUE(scale.has_value()) << length;
    EXPECT_NEAR(scale->baseline / T.t.norm(), 1.0, 0.02) << length;
    EXPECT_GE(scale->support, 40U);
  }
}

TEST(GroundScale, WorksForATiltedCamera) {
  SceneGenerator scene(32);
  const RelativePose level_motion = forward(0.8);
  const Eigen::Matrix3d L = levelling_rotation({8.0 * kDegree, 0.0});
  auto acs = road_and_walls(scene, level_motion, 80, 80, 0.3 * kSigma);
  for (auto& ac : acs) ac = *rotate_views(ac, L.transpose(), L.transpose());
  const auto scale = ground_scale(acs, std::vector<bool>(acs.size(), true),
                                  with_unit_length(unlevel(level_motion, L)), L, kSigma, {});
  ASSERT_TRUE(scale.has_value());
  EXPECT_NEAR(scale->baseline / level_motion.t.norm(), 1.0, 0.02);
}

/// Of a level road seen by a camera with this tilt that is believed to be level.
std::optional<GroundScale> seen_with(const Tilt& tilt, unsigned seed) {
  SceneGenerator scene(seed);
  const RelativePose level_motion = forward(0.8);
  const Eigen::Matrix3d L = levelling_rotation(tilt);
  auto acs = road_and_walls(scene, level_motion, 120, 0, 0.1 * kSigma);
  for (auto& ac : acs) ac = *rotate_views(ac, L.transpose(), L.transpose());
  return ground_scale(acs, std::vector<bool>(acs.size(), true),
                      with_unit_length(unlevel(level_motion, L)), kLevel, kSigma, {});
}

TEST(GroundScale, KeepsTheLengthOverASlope) {
  for (const Tilt& tilt : {Tilt{0.5 * kDegree, 0.0}, Tilt{0.0, 1.0 * kDegree}}) {
    const auto scale = seen_with(tilt, 35);
    ASSERT_TRUE(scale.has_value());
    EXPECT_NEAR(scale->baseline, 0.8, 0.016) << "half a degree unseen would change it by 5 %";
  }
}

TEST(GroundScale, LeavesOutTheFootway) {
  SceneGenerator scene(37);
  const RelativePose T{Eigen::Matrix3d::Identity(), {0.0, 0.0, -0.8}};
  const auto road = plane_induced_homography(T, {Eigen::Vector3d::UnitY(), 1.0});
  const auto footway = plane_induced_homography(T, {Eigen::Vector3d::UnitY(), 0.92});
  std::vector<AffineCorrespondence> acs;
  while (acs.size() < 200) {
    const Eigen::Vector2d x1 = scene.image_point(0.08, 0.4);
    const bool beside = std::abs(x1.x() / x1.y()) > 2.2;  // in camera heights
    acs.push_back(*correspondence_from_homography(beside ? footway : road, x1));
  }
  const auto scale = ground_scale(acs, std::vector<bool>(acs.size(), true), with_unit_length(T),
                                  kLevel, kSigma, {});
  ASSERT_TRUE(scale.has_value());
  EXPECT_NEAR(scale->baseline / T.t.norm(), 1.0, 0.005);
}

/// A camera that turns at a junction looks across the kerb: its own way lies beside the axis.
TEST(GroundScale, IsLessSureInABendOfWhatTheCarDoesNotDriveOn) {
  const auto seen = [](double turn) {
    SceneGenerator scene(39);
    const RelativePose T{yaw_rotation(std::cos(turn), std::sin(turn)),
                         0.5 * Eigen::Vector3d(std::sin(0.5 * turn), 0.0, -std::cos(0.5 * turn))};
    const auto road = plane_induced_homography(T, {Eigen::Vector3d::UnitY(), 1.0});
    std::vector<AffineCorrespondence> acs;
    while (acs.size() < 200) {
      acs.push_back(*correspondence_from_homography(road, scene.image_point(0.1, 0.3)));
    }
    return ground_scale(acs, std::vector<bool>(acs.size(), true), with_unit_length(T), kLevel,
                        kSigma, {});
  };
  const auto straight = seen(0.0), wide = seen(0.01), tight = seen(0.1);  // ∞, 50, 5 heights
  ASSERT_TRUE(straight && wide && tight);
  EXPECT_LT(straight->uncertainty, 0.01);
  EXPECT_NEAR(wide->uncertainty, straight->uncertainty, 0.005);
  EXPECT_GT(tight->uncertainty, 0.04) << "a kerb of 12 cm under 1.5 m makes 8 %";
  EXPECT_NEAR(tight->baseline, 0.5, 0.005) << "but it is no other length";
}

/// One sees the road on one side only, e.g. beside parked cars.
TEST(GroundScale, LetsTheRoadFallToTheSide) {
  SceneGenerator scene(38);
  const RelativePose T = forward(0.8);
  const Eigen::Vector3d normal = Eigen::Vector3d(0.025, 1.0, 0.0).normalized();
  const auto H = plane_induced_homography(T, {normal, 1.0});
  std::vector<AffineCorrespondence> acs;
  while (acs.size() < 20) {
    const Eigen::Vector2d x1 = scene.image_point(0.1, 0.4);
    if (x1.x() > 0.0) acs.push_back(*correspondence_from_homography(H, x1));
  }
  const auto scale = ground_scale(acs, std::vector<bool>(acs.size(), true), with_unit_length(T),
                                  kLevel, kSigma, {});
  ASSERT_TRUE(scale.has_value());
  EXPECT_NEAR(scale->baseline / T.t.norm(), 1.0, 0.018);
}

TEST(GroundScale, SaysHowFarAheadItsRoadIs) {
  const RelativePose T = forward(0.8);
  const auto reach = [&](double low_y, double high_y) {
    SceneGenerator scene(38);
    std::vector<AffineCorrespondence> acs;
    double squares = 0.0;
    while (acs.size() < 60) {
      const Eigen::Vector2d x1 = scene.image_point(low_y, high_y);
      const auto ac = correspondence_from_homography(
          plane_induced_homography(T, {Eigen::Vector3d::UnitY(), 1.0}), x1);
      if (!ac || std::abs(x1.x()) > 1.5 * x1.y()) continue;
      acs.push_back(*ac);
      squares += 1.0 / (x1.y() * x1.y());
    }
    const auto scale = ground_scale(acs, std::vector<bool>(acs.size(), true), with_unit_length(T),
                                    kLevel, kSigma, {});
    EXPECT_TRUE(scale.has_value());
    return std::make_pair(scale ? scale->reach : 0.0, std::sqrt(squares / 60.0));
  };
  for (const double far_y : {0.25, 0.1}) {
    const auto [told, truth] = reach(far_y, far_y + 0.1);
    EXPECT_NEAR(told / truth, 1.0, 0.1) << far_y;
  }
}

TEST(GroundScale, SaysNothingWithoutRoad) {
  SceneGenerator scene(33);
  const RelativePose T = forward(0.8);
  const auto acs = road_and_walls(scene, T, 0, 150, 0.3 * kSigma);
  EXPECT_FALSE(ground_scale(acs, std::vector<bool>(acs.size(), true), with_unit_length(T), kLevel,
                            kSigma, {})
                   .has_value());
}

/// On a smooth road the rear and the flank of a parked car are all that has corners: some of them
/// lie on any plane below the camera.
TEST(GroundScale, TakesNoCarForARoad) {
  const RelativePose T{Eigen::Matrix3d::Identity(), {0.0, 0.0, -0.6}};
  for (const Eigen::Vector3d& normal :
       {Eigen::Vector3d(Eigen::Vector3d::UnitZ()), Eigen::Vector3d(Eigen::Vector3d::UnitX())}) {
    SceneGenerator scene(34);
    const double distance = normal.z() > 0.0 ? 7.0 : 1.5;
    const auto wall = plane_induced_homography(T, {normal, distance});
    std::vector<AffineCorrespondence> acs;
    while (acs.size() < 100) {
      const Eigen::Vector2d x1 = scene.image_point(0.02, 0.24);
      const double depth = distance / normal.dot(x1.homogeneous());
      const bool on_car = depth > 4.0 && depth < 9.0 && depth * x1.y() > 0.3 &&
                          depth * x1.y() < 0.95 && std::abs(depth * x1.x()) < 1.8;
      if (!on_car) continue;
      const auto ac = correspondence_from_homography(wall, x1);
      acs.push_back(scene.with_noise(*ac, 0.3 * kSigma, 0.05));
    }
    EXPECT_FALSE(ground_scale(acs, std::vector<bool>(acs.size(), true), with_unit_length(T), kLevel,
                              kSigma, {}))
        << normal.transpose();
  }
}

/// A high camera that looks aside: a lane of road, and behind it the roofs of parked vans.
TEST(GroundScale, LooksNoFartherAsideThanTwoLanes) {
  SceneGenerator scene(35);
  const RelativePose T{Eigen::Matrix3d::Identity(), {0.3, 0.0, 0.0}};
  const auto road = plane_induced_homography(T, {Eigen::Vector3d::UnitY(), 1.0});
  const auto roofs = plane_induced_homography(T, {Eigen::Vector3d::UnitY(), 0.6});
  std::vector<AffineCorrespondence> acs;
  while (acs.size() < 200) {
    const Eigen::Vector2d x1 = scene.image_point(0.05, 0.5);
    const double aside = 1.0 / x1.y(), on_roof = 0.6 / x1.y();
    const bool roof = on_roof > 3.0 && on_roof < 5.0;
    if (!roof && (aside > 4.0 || acs.size() % 8 != 0)) continue;
    acs.push_back(*correspondence_from_homography(roof ? roofs : road, x1));
  }
  const auto scale = ground_scale(acs, std::vector<bool>(acs.size(), true), with_unit_length(T),
                                  kLevel, kSigma, {});
  ASSERT_TRUE(scale.has_value());
  EXPECT_NEAR(scale->baseline / T.t.norm(), 1.0, 0.01);
}

TEST(GroundScale, UsesInliersOnly) {
  SceneGenerator scene(34);
  const RelativePose T = forward(0.8);
  const auto acs = road_and_walls(scene, T, 80, 0, 0.3 * kSigma);
  EXPECT_FALSE(ground_scale(acs, std::vector<bool>(acs.size(), false), with_unit_length(T), kLevel,
                            kSigma, {})
                   .has_value());
}

TEST(GroundScale, SaysNothingWithoutTranslation) {
  EXPECT_FALSE(ground_scale({}, {}, RelativePose{}, kLevel, kSigma, {}).has_value());
}

TEST(GroundScaleOptions, NameFieldValueAndBound) {
  GroundScaleOptions options;
  options.bandwidth = 0.0;
  EXPECT_THROW(options.validate(), std::invalid_argument);
}

}  // namespace
}  // namespace oneac
