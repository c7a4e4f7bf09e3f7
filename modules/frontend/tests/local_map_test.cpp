#include "map/local_map.h"

#include "oneac/geometry/homography.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace oneac {
namespace {

constexpr double kFocal = 700.0;

/// A corridor of points that a car drives through, each on a plane of its own.
class Corridor {
 public:
  explicit Corridor(std::size_t points) {
    SceneGenerator random(9);
    for (std::size_t i = 0; i < points; ++i) {
      const double side = i % 2 == 0 ? 3.0 : -3.0;
      points_.push_back(
          {side + random.uniform(-0.5, 0.5), random.uniform(-2.0, 1.5), random.uniform(6.0, 60.0)});
    }
  }

  static RelativePose pose_at(double z) {
    return {Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.0, 0.0, -z)};
  }

  /// Correspondences of a drive from z1 to z2; the walls' normals point across the street.
  [[nodiscard]] TrackedPair step(double z1, double z2) const {
    TrackedPair pair;
    const RelativePose T = pose_at(z2) * pose_at(z1).inverse();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Eigen::Vector3d X = pose_at(z1) * points_[i];
      if (X.z() - (z2 - z1) < 2.0) continue;
      const Plane wall{Eigen::Vector3d::UnitX() * (X.x() > 0.0 ? 1.0 : -1.0), std::abs(X.x())};
      const auto ac =
          correspondence_from_homography(plane_induced_homography(T, wall), X.head<2>() / X.z());
      Correspondence full;
      static_cast<AffineCorrespondence&>(full) = *ac;
      full.track = i;
      full.affine_sigma = 0.001;  // exact data: the normals show
      pair.correspondences.push_back(full);
    }
    return pair;
  }

 private:
  std::vector<Eigen::Vector3d> points_;
};

/// Drives with a keyframe at every metre.
LocalMap driven_map(const Corridor& corridor, int metres, const WindowOptions& options = {}) {
  LocalMap map(options, kFocal);
  map.start(0, Corridor::pose_at(0.0));
  for (int z = 0; z < metres; ++z) {
    map.extend(corridor.step(z, z + 1.0), {});
    map.add_keyframe(static_cast<std::size_t>(z) + 1, Corridor::pose_at(z + 1.0));
    map.refine(Eigen::Matrix3d::Identity());
    while (map.is_over_full()) static_cast<void>(map.retire_oldest());
  }
  return map;
}

TEST(LocalMap, CarriesTheLengthOnWhenTheFocalLengthHasChanged) {
  constexpr double kFactor = 1.05;
  const Corridor corridor(200);
  LocalMap map = driven_map(corridor, 4);
  PinholeCamera camera, shorter;
  camera.fx = camera.fy = kFocal;
  shorter.fx = shorter.fy = kFocal / kFactor;
  map.renormalise({camera, shorter});
  TrackedPair step = corridor.step(4.0, 4.7);
  for (Correspondence& ac : step.correspondences) {
    ac.x1 *= kFactor;
    ac.x2 *= kFactor;
  }
  map.extend(step, {});
  const auto carried =
      map.carry({Eigen::Matrix3d::Identity(), -Eigen::Vector3d::UnitZ()}, Corridor::pose_at(4.0));
  ASSERT_TRUE(carried.has_value());
  EXPECT_NEAR(carried->length, 0.7, 1e-3);
}

TEST(LocalMap, CarriesTheLengthOfTheNextStep) {
  const Corridor corridor(200);
  LocalMap map = driven_map(corridor, 4);
  map.extend(corridor.step(4.0, 4.7), {});
  const auto carried =
      map.carry({Eigen::Matrix3d::Identity(), -Eigen::Vector3d::UnitZ()}, Corridor::pose_at(4.0));
  ASSERT_TRUE(carried.has_value());
  EXPECT_NEAR(carried->length, 0.7, 0.007);
  EXPECT_GT(carried->support, 50U);
}

TEST(LocalMap, CarriesNothingWithoutLandmarks) {
  const Corridor corridor(200);
  LocalMap map(WindowOptions{}, kFocal);
  map.start(0, {});
  map.extend(corridor.step(0.0, 1.0), {});
  EXPECT_FALSE(map.carry({Eigen::Matrix3d::Identity(), -Eigen::Vector3d::UnitZ()}, {}).has_value());
}

TEST(LocalMap, AStandingCameraNeedsNoKeyframe) {
  const Corridor corridor(200);
  LocalMap map = driven_map(corridor, 3);
  for (int i = 0; i < 50; ++i) {
    map.extend(corridor.step(3.0, 3.0), {});
    EXPECT_FALSE(map.needs_keyframe(Corridor::pose_at(3.0), 0.1 * i));
  }
}

TEST(LocalMap, ParallaxRotationAndLossOfTracksNeedOne) {
  const Corridor corridor(200);
  LocalMap map = driven_map(corridor, 3);
  map.extend(corridor.step(3.0, 8.0), {});
  EXPECT_TRUE(map.needs_keyframe(Corridor::pose_at(8.0), 0.1));

  map = driven_map(corridor, 3);
  map.extend(corridor.step(3.0, 3.0), {});
  RelativePose turned = Corridor::pose_at(3.0);
  turned.R = yaw_rotation(std::cos(0.2), std::sin(0.2)) * turned.R;
  EXPECT_TRUE(map.needs_keyframe(turned, 0.1));

  map = driven_map(corridor, 3);
  const TrackedPair few = corridor.step(3.0, 3.05);
  std::vector<bool> inliers(few.size(), false);
  for (std::size_t i = 0; i < inliers.size(); i += 3) inliers[i] = true;
  map.extend(few, inliers);
  EXPECT_TRUE(map.needs_keyframe(Corridor::pose_at(3.05), 0.1));
}

TEST(LocalMap, RescalesAboutItsOldestKeyframe) {
  const Corridor corridor(200);
  LocalMap map = driven_map(corridor, 12);
  const Eigen::Vector3d oldest = map.keyframes().front().T_cam_map.inverse().t;
  const Eigen::Vector3d newest = map.keyframes().back().T_cam_map.inverse().t;
  map.rescale(2.0);
  EXPECT_LT((map.keyframes().front().T_cam_map.inverse().t - oldest).norm(), 1e-12);
  const Eigen::Vector3d now = map.keyframes().back().T_cam_map.inverse().t;
  EXPECT_LT((now - oldest - 2.0 * (newest - oldest)).norm(), 1e-9);
  map.extend(corridor.step(12.0, 12.5), {});
  const auto carried = map.carry({Eigen::Matrix3d::Identity(), -Eigen::Vector3d::UnitZ()},
                                 map.keyframes().back().T_cam_map);
  ASSERT_TRUE(carried.has_value());
  EXPECT_NEAR(carried->length, 1.0, 0.02);
}

TEST(LocalMap, GivesItsPointsAwayWithTheirNormals) {
  const Corridor corridor(300);
  LocalMap map = driven_map(corridor, 7);
  std::vector<MapPoint> points;
  while (!map.keyframes().empty()) {
    for (const MapPoint& point : map.retire_oldest()) points.push_back(point);
  }
  ASSERT_GT(points.size(), 60U);
  std::size_t on_wall = 0, across = 0, with_normal = 0;
  for (const MapPoint& point : points) {
    if (std::abs(std::abs(point.position.x()) - 3.0) < 0.6) ++on_wall;
    if (point.normal.isZero()) continue;
    ++with_normal;
    // The wall on the right faces left.
    if (point.normal.x() * point.position.x() < 0.0 && std::abs(point.normal.x()) > 0.9) ++across;
  }
  EXPECT_GT(on_wall, points.size() * 9 / 10);
  EXPECT_GT(with_normal, points.size() / 2);
  EXPECT_GT(across, with_normal * 9 / 10);
}

TEST(LocalMap, GivesTheSightingsOfItsLandmarksAwayWhereTheyAreAskedFor) {
  const Corridor corridor(300);
  WindowOptions options;
  options.keep_sightings = true;
  LocalMap map = driven_map(corridor, 12, options);
  std::size_t points = 0;
  const SettledTracks before = map.take_tracks();
  while (!map.keyframes().empty()) points += map.retire_oldest().size();
  const SettledTracks tracks = map.take_tracks();
  EXPECT_EQ(tracks.of_points.size(), points);
  EXPECT_TRUE(map.take_tracks().sightings.empty());
  std::map<std::uint64_t, std::vector<SettledSighting>> by_track;
  for (const SettledTracks* some : {&before, &tracks}) {
    for (const SettledSighting& seen : some->sightings) by_track[seen.track].push_back(seen);
  }
  for (const auto& [track, seen] : by_track) {
    EXPECT_GE(seen.size(), 2U) << track;
    for (std::size_t i = 1; i < seen.size(); ++i) {
      EXPECT_GT(seen[i].keyframe, seen[i - 1].keyframe) << track;
      // Along a corridor everything moves away from the middle.
      EXPECT_GT(seen[i].u.norm(), seen[i - 1].u.norm()) << track;
    }
    EXPECT_LT(seen.back().u.norm(), 2.0 * kFocal);
    EXPECT_GT(seen.back().u.norm(), 1.0);
  }
  for (const std::uint64_t track : tracks.of_points) EXPECT_EQ(by_track.count(track), 1U);
  EXPECT_GT(by_track.size(), points / 2);
}

TEST(LocalMap, KeepsNoSightingsThatNobodyAskedFor) {
  LocalMap map = driven_map(Corridor(300), 12);
  while (!map.keyframes().empty()) static_cast<void>(map.retire_oldest());
  EXPECT_TRUE(map.take_tracks().sightings.empty());
  EXPECT_TRUE(map.take_tracks().of_points.empty());
}

/// The step with the tracks below `number` only.
TrackedPair first_of(const TrackedPair& step, std::uint64_t number) {
  TrackedPair first;
  for (const Correspondence& ac : step.correspondences) {
    if (ac.track < number) first.correspondences.push_back(ac);
  }
  return first;
}

/// Most landmarks are met with a keyframe a tenth too far on; a few old ones put it right.
TEST(LocalMap, CorrectsLandmarksThatTookNoPartInTheAdjustment) {
  const Corridor corridor(300);
  WindowOptions options;
  options.max_landmarks = 40;
  LocalMap map(options, kFocal);
  map.start(0, Corridor::pose_at(0.0));
  for (int z = 0; z < 5; ++z) {
    const TrackedPair step = corridor.step(z, z + 1.0);
    map.extend(z < 4 ? first_of(step, 60) : step, {});
    map.add_keyframe(static_cast<std::size_t>(z) + 1, Corridor::pose_at(z < 4 ? z + 1.0 : 5.1));
    map.refine(Eigen::Matrix3d::Identity());
  }
  const RelativePose newest = map.keyframes().back().T_cam_map;
  EXPECT_NEAR(newest.t.norm(), 5.0, 0.02);
  map.extend(corridor.step(5.0, 5.7), {});
  const auto carried = map.carry({Eigen::Matrix3d::Identity(), -Eigen::Vector3d::UnitZ()}, newest);
  ASSERT_TRUE(carried.has_value());
  EXPECT_NEAR(carried->length, 0.7, 0.015);
}

TEST(LocalMap, HoldsNoMoreThanItsWindow) {
  const Corridor corridor(400);
  const LocalMap map = driven_map(corridor, 30);
  EXPECT_EQ(map.keyframes().size(), 8U);
  for (const auto& [id, track] : map.tracks()) {
    EXPECT_LE(track.seen.size(), 8U);
    for (const Sighting& s : track.seen) EXPECT_GE(s.keyframe, map.keyframes().front().id);
  }
}

}  // namespace
}  // namespace oneac
