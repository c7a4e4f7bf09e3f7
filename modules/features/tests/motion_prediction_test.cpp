#include "klt/motion_prediction.h"

#include "klt/static_points.h"

#include "oneac/geometry/levelling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

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
/// @param metric    whether the motion expected has a length
/// @param by_place  they had to move whatever it is
StaticPoints after_drive(double resting_share, bool metric = true, bool by_place = false) {
  const MotionHint h = hint(metric);
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
          points.rests(track, at_rest ? Eigen::Vector2d(0.05, 0.0) : flow, motion, by_place));
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
  EXPECT_FALSE(after_drive(0.0, false, true).views_through_dirt());
  EXPECT_TRUE(after_drive(0.2, false, true).views_through_dirt());
}

TEST(StaticPoints, ARedLightDoesNotCleanTheGlass) {
  StaticPoints points = after_drive(0.2);
  for (std::size_t pair = 50; pair < 400; ++pair) points.begin_pair(pair, 0.0);
  EXPECT_TRUE(points.views_through_dirt());
}

/// Where a point of the first view is seen after the motion of the hint, once and twice.
std::pair<Eigen::Vector2d, Eigen::Vector2d> places(const MotionHint& h, const Eigen::Vector2d& u,
                                                   double depth) {
  const auto seen = [&](const Eigen::Vector3d& X) {
    return h.camera.project({X.x() / X.z(), X.y() / X.z()});
  };
  const Eigen::Vector2d x = h.camera.normalise(u);
  const Eigen::Vector3d once = *h.T_2_1 * Eigen::Vector3d(depth * x.x(), depth * x.y(), depth);
  return {seen(once), seen(*h.T_2_1 * once)};
}

TEST(MotionPrediction, CarriesAPointOnByTheDepthThatItShowed) {
  const MotionHint h = hint(false);
  const MotionPrediction motion(h);
  for (const double depth : {4.0, 8.0, 20.0, 1000.0}) {
    for (const Eigen::Vector2d& u :
         {Eigen::Vector2d(300, 100), Eigen::Vector2d(450, 380), Eigen::Vector2d(900, 250)}) {
      const auto [once, twice] = places(h, u, depth);
      const auto place = motion.goes_on(u, once);
      ASSERT_TRUE(place) << depth;
      EXPECT_LT((place->u - twice).norm(), 0.1) << depth;
      const auto far = motion.far_away(once);
      EXPECT_LT((place->u - place->by_travel - far->centre).norm(), 1e-6) << depth;
    }
  }
}

TEST(MotionPrediction, SaysNothingOfAPointThatGoesItsOwnWay) {
  const MotionHint h = hint(false);
  const Eigen::Vector2d u(450.0, 380.0);
  const Eigen::Vector2d once = places(h, u, 8.0).first, travel(514.0, 181.0);
  const Eigen::Vector2d aside = Eigen::Vector2d((once - travel).y(), -(once - travel).x());
  EXPECT_FALSE(MotionPrediction(h).goes_on(u, once + 5.0 * aside.normalized()));
  MotionHint none = h;
  none.T_2_1.reset();
  EXPECT_FALSE(MotionPrediction(none).goes_on(u, once));
}

/// Points over the image that missed their places by a turn and a speed, some by anything.
std::vector<MissedPlace> missed_places(const Eigen::Vector3d& turn, double speed, int wrong) {
  std::vector<MissedPlace> missed;
  const MotionCorrection truth{turn, speed, 0.0};
  for (int i = 0; i < 40; ++i) {
    MissedPlace place;
    place.expected = {0.8 * std::sin(1.7 * i), 0.25 * std::cos(2.9 * i)};
    place.by_travel = 0.05 * (1.0 + std::sin(5.3 * i)) * place.expected;
    place.found = place.expected + truth.shift(place.expected, place.by_travel);
    if (i < wrong) place.found += Eigen::Vector2d(0.03 * std::cos(4.1 * i), 0.03);
    missed.push_back(place);
  }
  return missed;
}

TEST(MotionCorrection, FindsTurnAndSpeedAmongPointsThatGoTheirOwnWay) {
  const Eigen::Vector3d turn(0.006, -0.002, 0.003);
  for (const int wrong : {0, 10}) {
    const auto found = correction_of(missed_places(turn, 0.04, wrong));
    ASSERT_TRUE(found);
    EXPECT_LT((found->turn - turn).norm(), 2e-4) << wrong;
    EXPECT_NEAR(found->speed, 0.04, 0.02) << wrong;
    EXPECT_LT(found->error, 3e-4) << wrong;
  }
}

TEST(MotionCorrection, TellsTheErrorThatIsLeft) {
  std::vector<MissedPlace> places = missed_places({0.0, 0.0, 0.0}, 0.0, 0);
  for (std::size_t i = 0; i < places.size(); ++i) {
    places[i].found.y() += i % 2 == 0 ? 0.01 : -0.01;
  }
  const auto found = correction_of(places);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->error, 0.01, 0.002);
}

TEST(MotionCorrection, AsksADozenPlaces) {
  std::vector<MissedPlace> places = missed_places({0.001, 0.0, 0.0}, 0.0, 0);
  places.resize(11);
  EXPECT_FALSE(correction_of(places));
}

TEST(MotionPrediction, TurnsAndLengthensItsMotion) {
  const MotionHint h = hint(true);
  const MotionCorrection correction{{0.004, -0.003, 0.002}, 0.1, 0.0};
  MotionHint changed = h;
  const Eigen::Matrix3d turn = rotation_from_vector(correction.turn);
  changed.T_2_1 = RelativePose{turn * h.T_2_1->R, 1.1 * (turn * h.T_2_1->t)};
  const Eigen::Vector2d u(450.0, 420.0);
  const auto corrected = MotionPrediction(h).corrected(correction);
  EXPECT_LT((corrected.on_road(u)->centre - MotionPrediction(changed).on_road(u)->centre).norm(),
            1e-9);
  EXPECT_LT((corrected.far_away(u)->centre - MotionPrediction(changed).far_away(u)->centre).norm(),
            1e-9);
}

TEST(MotionPrediction, KnowsNothingWithoutAMotion) {
  MotionHint none = hint(true);
  none.T_2_1.reset();
  EXPECT_FALSE(MotionPrediction(none).on_road({450.0, 420.0}));
  EXPECT_FALSE(MotionPrediction(none).far_away({450.0, 420.0}));
}

}  // namespace
}  // namespace oneac::internal
