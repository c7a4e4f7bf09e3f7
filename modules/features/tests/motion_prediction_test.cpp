#include "klt/motion_prediction.h"

#include "klt/static_points.h"

#include "oneac/geometry/levelling.h"

#include <gtest/gtest.h>

namespace oneac::internal {
namespace {

/// A camera that looks 5° up, drives 0.7 camera heights and turns.
MotionHint hint(bool scaled) {
  MotionHint hint;
  hint.camera.fx = 700.0;
  hint.camera.fy = 650.0;
  hint.camera.cx = 600.0;
  hint.camera.cy = 200.0;
  hint.R_level_cam = levelling_rotation({0.087, 0.0});
  hint.T_2_1 = RelativePose{rotation_from_vector({0.01, 0.05, -0.02}), {0.1, 0.02, -0.7}};
  hint.scaled = scaled;
  return hint;
}

/// Where the point of the road under a pixel is seen after the motion.
Eigen::Vector2d road_point(const MotionHint& h, const Eigen::Vector2d& u) {
  const Eigen::Vector2d x = h.camera.normalise(u);
  const Eigen::Vector3d ray(x.x(), x.y(), 1.0);
  const Eigen::Vector3d X = ray / (h.R_level_cam * ray).y();
  const Eigen::Vector3d moved = *h.T_2_1 * X;
  return h.camera.project({moved.x() / moved.z(), moved.y() / moved.z()});
}

TEST(MotionPrediction, PlacesAndShapesPatchesOfTheRoad) {
  const MotionHint h = hint(true);
  const MotionPrediction motion(h);
  const Eigen::Vector2d u(450.0, 420.0), dx(0.01, 0.0), dy(0.0, 0.01);
  const auto warp = motion.on_road(u);
  ASSERT_TRUE(warp);
  EXPECT_LT((warp->centre - road_point(h, u)).norm(), 1e-6);
  Eigen::Matrix2d numeric;
  numeric.col(0) = (road_point(h, u + dx) - road_point(h, u - dx)) / 0.02;
  numeric.col(1) = (road_point(h, u + dy) - road_point(h, u - dy)) / 0.02;
  EXPECT_LT((warp->M - numeric).norm(), 1e-4);
}

TEST(MotionPrediction, SaysNothingAboutTheRoadAboveTheHorizonOrWithoutScale) {
  // 5° up: the horizon is 57 px below the centre.
  EXPECT_FALSE(MotionPrediction(hint(true)).on_road({600.0, 250.0}));
  EXPECT_FALSE(MotionPrediction(hint(false)).on_road({450.0, 420.0}));
  EXPECT_TRUE(MotionPrediction(hint(false)).far_away({450.0, 420.0}));
}

/// Of points of the road seen in fifty pairs, this share keeps its place in the picture.
StaticPoints after_drive(double resting_share) {
  const MotionHint h = hint(true);
  const MotionPrediction motion(h);
  StaticPoints points(5);
  for (std::size_t pair = 0; pair < 50; ++pair) {
    points.begin_pair(pair, 10.0);
    for (int i = 0; i < 20; ++i) {
      KltTrack track;
      track.u = {350.0 + 10.0 * i, 420.0};
      const Eigen::Vector2d flow = road_point(h, track.u) - track.u;
      const bool at_rest = i < 20.0 * resting_share;
      static_cast<void>(
          points.rests(track, at_rest ? Eigen::Vector2d(0.05, 0.0) : flow, motion, false));
    }
  }
  return points;
}

TEST(StaticPoints, SeesDirtOnTheGlassWhereATenthOfTheRoadRests) {
  EXPECT_FALSE(StaticPoints(5).views_through_dirt()) << "nothing had to move yet";
  EXPECT_FALSE(after_drive(0.0).views_through_dirt());
  EXPECT_FALSE(after_drive(0.05).views_through_dirt()) << "a truck keeps its distance";
  EXPECT_TRUE(after_drive(0.2).views_through_dirt());
}

TEST(StaticPoints, SeesDirtWhereTravelIsShownBeforeMetresAreKnown) {
  const MotionHint h = hint(false);
  const MotionPrediction motion(h);
  StaticPoints points(5);
  for (std::size_t pair = 0; pair < 50; ++pair) {
    points.begin_pair(pair, 10.0);
    for (int i = 0; i < 20; ++i) {
      KltTrack track;
      track.u = {350.0 + 10.0 * i, 420.0};
      static_cast<void>(points.rests(track, {i < 4 ? 0.05 : 5.0, 0.0}, motion, true));
    }
  }
  EXPECT_TRUE(points.views_through_dirt());
}

TEST(StaticPoints, ARedLightDoesNotCleanTheGlass) {
  StaticPoints points = after_drive(0.2);
  for (std::size_t pair = 50; pair < 400; ++pair) points.begin_pair(pair, 0.0);
  EXPECT_TRUE(points.views_through_dirt());
}

TEST(MotionPrediction, KnowsNothingWithoutAMotion) {
  MotionHint none = hint(true);
  none.T_2_1.reset();
  EXPECT_FALSE(MotionPrediction(none).on_road({450.0, 420.0}));
  EXPECT_FALSE(MotionPrediction(none).far_away({450.0, 420.0}));
}

}  // namespace
}  // namespace oneac::internal
