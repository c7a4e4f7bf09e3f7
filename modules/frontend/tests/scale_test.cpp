#include "scale/scale.h"

#include "scale/depth_scale.h"
#include "scale/room.h"

#include "oneac/frontend/front_end_options.h"
#include "oneac/geometry/homography.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oneac {
namespace {

constexpr double kHeight = 1.5;
constexpr double kFocal = 700.0;
const Eigen::Vector3d kAhead = -Eigen::Vector3d::UnitZ();  // t of a car that drives on

FrontEndOptions by(const char* source) {
  FrontEndOptions options;
  options.scale.source = source;
  options.camera_height = kHeight;
  return options;
}

Scale started(const FrontEndOptions& options) {
  Scale scale(options);
  scale.start({});
  return scale;
}

/// A road under the camera, and a car that drives this far [m].
KeyframePair road(double metres, double length_in_map) {
  SceneGenerator random(3);
  const RelativePose T{Eigen::Matrix3d::Identity(), {0.0, 0.0, -metres}};
  const Plane ground{Eigen::Vector3d::UnitY(), kHeight};
  KeyframePair pair;
  for (int i = 0; i < 120; ++i) {
    const Eigen::Vector2d x1(random.uniform(-0.3, 0.3), random.uniform(0.12, 0.4));
    const auto ac = correspondence_from_homography(plane_induced_homography(T, ground), x1);
    if (ac) pair.acs.push_back(*ac);
  }
  pair.T_2_1 = {T.R, {0.0, 0.0, -length_in_map}};
  return pair;
}

TwoView seen_road(double metres) {
  const KeyframePair pair = road(metres, 1.0);
  TwoView seen;
  seen.status = StepStatus::kOk;
  seen.pose = pair.T_2_1;
  seen.focal_px = kFocal;
  seen.inliers.assign(pair.acs.size(), true);
  for (const AffineCorrespondence& ac : pair.acs) {
    seen.pair.correspondences.emplace_back();
    static_cast<AffineCorrespondence&>(seen.pair.correspondences.back()) = ac;
  }
  return seen;
}

StepInTime step(StepStatus status, double begin_s, double expected_length) {
  StepInTime step;
  step.status = status;
  step.begin_s = begin_s;
  step.end_s = begin_s + 0.1;
  step.expected = {Eigen::Matrix3d::Identity(), {0.0, 0.0, -expected_length}};
  return step;
}

LengthMeasurement carried(double length) {
  return {length, 0.01, LengthSource::kMap, 40};
}

TEST(Scale, AsksTheRoadWhereTheMapDoesNotCarryTheLength) {
  Scale scale = started(by("height"));
  const auto told = scale.measure(seen_road(0.9), std::nullopt, {}, kAhead);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].source, LengthSource::kRoad);
  const StepLength length = scale.length_of(step(StepStatus::kOk, 0.0, 0.0), told);
  EXPECT_NEAR(length.length, 0.9, 0.02);
  EXPECT_TRUE(length.metric);
  EXPECT_GT(length.ground_acs, 30U);
  EXPECT_EQ(length.landmarks, 0U);
}

TEST(Scale, TakesTheMapsWordBeforeTheRoads) {
  Scale scale = started(by("height"));
  const auto told = scale.measure(seen_road(0.9), carried(2.0), {}, kAhead);
  const StepLength length = scale.length_of(step(StepStatus::kOk, 0.0, 0.0), told);
  EXPECT_EQ(length.source, LengthSource::kMap);
  EXPECT_EQ(length.length, 2.0);
  EXPECT_FALSE(length.metric) << "nobody has measured the map";
  EXPECT_EQ(length.sigma, 0.0);
  EXPECT_EQ(length.landmarks, 40U);
}

TEST(Scale, IsMetricOnceTheRoadHasMeasuredTheMap) {
  Scale scale = started(by("height"));
  const ScaleCorrection correction = scale.correct({road(0.9, 1.8), {}}, {}, kFocal);
  EXPECT_NEAR(correction.factor, 0.5, 0.01);
  EXPECT_TRUE(correction.metric);
  EXPECT_GT(correction.ground_acs, 30U);
  const StepLength length = scale.length_of(step(StepStatus::kOk, 0.0, 0.0), {carried(0.9)});
  EXPECT_TRUE(length.metric);
  EXPECT_GT(length.sigma, 0.01) << "that of the landmarks and that of the map";
  scale.restart(0.1);
  EXPECT_FALSE(scale.is_metric());
  EXPECT_TRUE(std::isinf(scale.uncertainty()));
}

TEST(Scale, AFewCornersOfTheRoadDoNotBeginWithACreep) {
  const auto begins = [](double metres, std::size_t corners) {
    KeyframePair pair = road(metres, 1.0);
    pair.acs.resize(corners);
    Scale scale = started(by("height"));
    return scale.correct({pair, {}}, {}, kFocal).metric;
  };
  EXPECT_FALSE(begins(0.12, 15)) << "slipped by nearly a slab";
  EXPECT_TRUE(begins(0.12, 100));
  EXPECT_TRUE(begins(0.9, 15));
}

TEST(Scale, TrustsAMapLessThatWasCarriedBadly) {
  const auto share_after = [](double sigma) {
    Scale scale = started(by("height"));
    static_cast<void>(scale.correct({road(0.9, 0.9), {}}, {}, kFocal));
    LengthMeasurement told = carried(1.0);
    told.sigma = sigma;
    static_cast<void>(scale.length_of(step(StepStatus::kOk, 0.0, 1.0), {told}));
    return scale.correct({road(0.9, 0.9), {}}, {}, kFocal).share;
  };
  EXPECT_LT(share_after(0.2), 0.5 * share_after(0.01));
}

StepInTime rest(std::optional<MeasuredTravel> road) {
  StepInTime resting = step(StepStatus::kNoMotion, 10.1, 1.0);
  resting.direct = road;
  return resting;
}

/// A drive that has just gone 1 m in a tenth of a second.
Scale driving() {
  Scale scale = started(by("height"));
  static_cast<void>(
      scale.length_of(step(StepStatus::kOk, 10.0, 1.0), {{1.0, 0.01, LengthSource::kRoad, 50}}));
  return scale;
}

TEST(Scale, ACameraWhoseRoadRestsDrivesZeroMetres) {
  Scale scale = started(by("height"));
  const StepLength length =
      scale.length_of(rest(MeasuredTravel{0.001, 0.004, LengthSource::kRoadImage, true}), {});
  EXPECT_TRUE(length.metric);
  EXPECT_EQ(length.length, 0.0);
  EXPECT_NEAR(length.sigma_m, std::hypot(0.004, 0.001), 1e-12) << "it may have crept";
  EXPECT_EQ(length.source, LengthSource::kStanding);
}

TEST(Scale, ARestThatNobodySawOnTheRoadIsNotMetric) {
  Scale scale = started(by("height"));
  EXPECT_FALSE(scale.length_of(rest({}), {}).metric);
}

TEST(Scale, ARestThatMayBeTheBonnetsIsNotMetricBeforeASpeedIsKnown) {
  const auto rest_of_a_drive = [](bool moved, bool car_is_known, bool began_at_rest) {
    Scale scale = started(by("height"));
    const StepStatus before = moved ? StepStatus::kOk : StepStatus::kNoMotion;
    static_cast<void>(scale.length_of(step(before, 10.0, 1.0), {}));
    StepInTime resting = rest(MeasuredTravel{0.001, 0.004, LengthSource::kRoadImage, true});
    resting.car_is_known = car_is_known;
    resting.began_at_rest = began_at_rest;
    return scale.length_of(resting, {});
  };
  EXPECT_TRUE(rest_of_a_drive(false, false, true).metric) << "all has kept its place for a while";
  EXPECT_FALSE(rest_of_a_drive(false, false, false).metric) << "the bonnet and far scenery may do";
  EXPECT_FALSE(rest_of_a_drive(true, false, true).metric);
  EXPECT_TRUE(rest_of_a_drive(true, true, false).metric) << "the bonnet is masked, or is none";
}

TEST(Scale, ACreepThatMayBeTheBonnetsIsNotMetricBeforeASpeedIsKnown) {
  const auto first_step = [](double length, bool car_is_known) {
    Scale scale = started(by("height"));
    StepInTime first = step(StepStatus::kOk, 10.0, 1.0);
    first.direct = MeasuredTravel{length, 0.004, LengthSource::kRoadImage, true};
    first.car_is_known = car_is_known;
    return scale.length_of(first, {});
  };
  EXPECT_FALSE(first_step(0.04, false).metric);
  EXPECT_TRUE(first_step(0.04, true).metric);
  EXPECT_TRUE(first_step(0.4, false).metric) << "no bonnet rests by so much noise";
  StepInTime creeping = rest(MeasuredTravel{0.08, 0.01, LengthSource::kRoadImage, true});
  creeping.car_is_known = false;
  EXPECT_FALSE(started(by("height")).length_of(creeping, {}).metric);
}

TEST(Scale, ImagesThatShowTravelShowNoRestBeforeASpeedIsKnown) {
  Scale scale = started(by("height"));
  StepInTime resting = rest(MeasuredTravel{0.001, 0.004, LengthSource::kRoadImage, true});
  resting.shows_travel = true;
  const StepLength length = scale.length_of(resting, {});
  EXPECT_FALSE(length.metric);
  EXPECT_GT(length.length, 0.0);
}

TEST(Scale, StepsWhoseDirectionsContradictEachOtherDoNotMeasureTheMap) {
  const auto factor_of = [](double net_in_map) {
    Scale scale = started(by("height"));
    for (int i = 0; i < 10; ++i) {
      StepInTime next = step(StepStatus::kOk, 10.0 + 0.1 * i, 0.1);
      next.direct = MeasuredTravel{0.1, 0.002, LengthSource::kRoadImage, true};
      static_cast<void>(scale.length_of(next, {}));
    }
    return scale
        .correct({{{}, {Eigen::Matrix3d::Identity(), {0.0, 0.0, -net_in_map}}}, {}}, {}, kFocal)
        .factor;
  };
  EXPECT_NEAR(factor_of(0.8), 1.25, 0.02) << "ten steps of 0.1 m that the window has shortened";
  EXPECT_EQ(factor_of(0.2), 1.0) << "there and back: it would stretch the map fivefold";
}

TEST(Scale, ARestOfAFewPointsIsNotMetricUnlessTheCarStoodBefore) {
  const auto rest_of = [](double share, bool stood) {
    Scale scale = started(by("height"));
    const double way = stood ? 0.001 : 0.05;
    static_cast<void>(
        scale.length_of(step(StepStatus::kOk, 10.0, way), {{way, 0.01, LengthSource::kRoad, 50}}));
    StepInTime resting = rest(MeasuredTravel{0.001, 0.004, LengthSource::kRoadImage, true});
    resting.resting = share;
    return scale.length_of(resting, {});
  };
  EXPECT_TRUE(rest_of(0.9, false).metric);
  EXPECT_FALSE(rest_of(0.1, false).metric) << "edges of compressed blocks rest by chance";
  EXPECT_TRUE(rest_of(0.1, true).metric) << "a bus passes";
  EXPECT_FALSE(rest_of(0.03, true).metric) << "nor does a bus hide everything";
}

TEST(Scale, ACarOfWhichNothingIsKnownRestsOnlyIfNearlyAllPointsDo) {
  const auto rest_of = [](double share) {
    StepInTime resting = rest(MeasuredTravel{0.001, 0.004, LengthSource::kRoadImage, true});
    resting.resting = share;
    Scale scale = started(by("height"));
    return scale.length_of(resting, {});
  };
  EXPECT_TRUE(rest_of(0.98).metric);
  EXPECT_FALSE(rest_of(0.55).metric) << "clouds";
  EXPECT_FALSE(rest_of(0.93).metric) << "a bonnet";
}

TEST(Scale, ACreepThatAFewPointsSeeIsNoFirstSpeed) {
  const auto creep_of = [](double share) {
    StepInTime creeping = rest(MeasuredTravel{0.08, 0.01, LengthSource::kRoadImage, true});
    creeping.resting = share;
    Scale scale = started(by("height"));
    return scale.length_of(creeping, {});
  };
  EXPECT_TRUE(creep_of(0.98).metric);
  EXPECT_FALSE(creep_of(0.85).metric) << "edges of the blocks of a compressed picture";
}

TEST(Scale, ARestSeenThroughDirtIsNotMetric) {
  Scale scale = started(by("height"));
  StepInTime resting = rest(MeasuredTravel{0.001, 0.004, LengthSource::kRoadImage, true});
  resting.through_dirt = true;
  EXPECT_FALSE(scale.length_of(resting, {}).metric);
}

StepInTime on_the_road(double begin_s, double metres) {
  StepInTime next = step(StepStatus::kOk, begin_s, metres);
  next.direct = MeasuredTravel{metres, 0.04, LengthSource::kRoadImage, true};
  return next;
}

TEST(Scale, TheFirstStepInMetresScalesTheMapThatCarriesIt) {
  Scale scale = started(by("height"));
  const StepInTime first = on_the_road(10.0, 1.3);
  const auto begun = scale.begin(first, carried(0.8));
  ASSERT_TRUE(begun);
  EXPECT_NEAR(begun->factor, 1.3 / 0.8, 1e-9);
  EXPECT_TRUE(begun->metric);
  EXPECT_GT(begun->sigma, 0.04 / 1.3);
  EXPECT_NEAR(scale.length_of(first, {}).length, 1.3, 1e-12);
  const StepLength next = scale.length_of(step(StepStatus::kOk, 10.1, 1.3), {carried(1.31)});
  EXPECT_EQ(next.source, LengthSource::kMap);
  EXPECT_TRUE(next.metric);
  EXPECT_FALSE(scale.begin(on_the_road(10.2, 1.3), carried(1.3))) << "it has a scale";
}

TEST(Scale, AStepFasterThanAnyCarScalesNoMap) {
  Scale scale = started(by("height"));
  EXPECT_FALSE(scale.begin(on_the_road(10.0, 8.0), carried(0.8)));
  EXPECT_FALSE(scale.begin(step(StepStatus::kOk, 10.0, 1.0), carried(0.8))) << "not in metres";
}

/// Scaled by 1.3 m on 0.8, then carried so badly that it is not metric any more.
Scale unsure() {
  Scale scale = started(by("height"));
  const StepInTime first = on_the_road(10.0, 1.3);
  static_cast<void>(scale.begin(first, carried(0.8)));
  static_cast<void>(scale.length_of(first, {}));
  LengthMeasurement badly = carried(1.3);
  badly.sigma = 0.025;
  static_cast<void>(scale.length_of(step(StepStatus::kOk, 10.1, 1.3), {badly}));
  const KeyframePair without_road{{}, {Eigen::Matrix3d::Identity(), {0.0, 0.0, -2.6}}};
  static_cast<void>(scale.correct({without_road, {}}, {}, kFocal));
  return scale;
}

TEST(Scale, AMapThatIsUnsureStillTellsWhatInertiaCannotBeRightAbout) {
  Scale agrees = unsure(), contradicts = unsure();
  ASSERT_FALSE(agrees.is_metric());
  ASSERT_LT(agrees.uncertainty(), 0.2);
  const StepInTime next = step(StepStatus::kOk, 10.2, 1.3);
  EXPECT_TRUE(agrees.length_of(next, {carried(1.35)}).metric) << "inertia goes on";
  EXPECT_FALSE(contradicts.length_of(next, {carried(3.9)}).metric) << "images were dropped";
}

TEST(Scale, AMapThatIsUnsureStillTellsWhatTheRoadCannotBeRightAbout) {
  Scale scale = unsure();
  const StepLength length = scale.length_of(on_the_road(10.2, 1.2), {carried(3.9)});
  EXPECT_FALSE(length.metric);
  EXPECT_TRUE(length.conflict);
}

TEST(Scale, ARollThatNobodyKnowsIsInEveryLengthByTheRoad) {
  const auto sigma_with = [](double roll_sigma) {
    Scale scale = started(by("height"));
    const Levelling level{Eigen::Matrix3d::Identity(), 0.0, roll_sigma};
    const StepInTime next = step(StepStatus::kOk, 10.0, 1.0);
    static_cast<void>(scale.measure_directly({}, seen_road(1.0), {}, level, kAhead, next));
    return scale.length_of(next, {{1.0, 0.01, LengthSource::kRoad, 50}}).sigma;
  };
  EXPECT_NEAR(sigma_with(0.02), std::hypot(sigma_with(0.0), 0.02), 1e-9);
}

TEST(Scale, ARoadAlongAWayThatWheelsDoNotGoTellsNothing) {
  Scale scale = started(by("height"));
  EXPECT_EQ(scale.measure(seen_road(0.9), std::nullopt, {}, Eigen::Vector3d::UnitX()).size(), 0U);
  EXPECT_EQ(scale.measure(seen_road(0.9), std::nullopt, {}, -kAhead).size(), 1U) << "astern";
}

TEST(RoomBeside, IsOneHeightOnARoadAndShrinksWithALengthThatIsTooShort) {
  const KeyframePair pair = road(0.9, 0.9);
  const std::vector<bool> all(pair.acs.size(), true);
  const double room = room_beside(pair.acs, all, pair.T_2_1);
  EXPECT_GE(room, kHeight);
  EXPECT_TRUE(is_wide_enough(room / kHeight));
  EXPECT_FALSE(is_wide_enough(0.03 * room / kHeight)) << "the bonnet was taken for the road";
}

TEST(RoomBeside, IsUnboundedWhereNothingIsSeen) {
  EXPECT_TRUE(std::isinf(room_beside({}, {}, {Eigen::Matrix3d::Identity(), -kAhead})));
}

TEST(Scale, ARestIsNoWayHoweverItsNoiseAddsUp) {
  Scale scale = started(by("height"));
  const auto told = [&](double begin_s, StepStatus status, double length) {
    StepInTime next = step(status, begin_s, 0.1);
    next.direct = MeasuredTravel{length, 0.005, LengthSource::kRoadImage, true};
    static_cast<void>(scale.length_of(next, {}));
  };
  for (int i = 0; i < 10; ++i) told(10.0 + 0.1 * i, StepStatus::kOk, 0.05);
  for (int i = 10; i < 60; ++i) told(10.0 + 0.1 * i, StepStatus::kNoMotion, 0.006);
  const ScaleCorrection correction =
      scale.correct({{{}, {Eigen::Matrix3d::Identity(), {0.0, 0.0, -0.5}}}, {}}, {}, kFocal);
  EXPECT_NEAR(correction.factor, 1.0, 0.02);
}

TEST(Scale, ARestThatNobodySawDoesNotConfirmItself) {
  Scale scale = started(by("height"));
  static_cast<void>(
      scale.length_of(step(StepStatus::kOk, 10.0, 0.03), {{0.03, 0.01, LengthSource::kRoad, 50}}));
  int metric = 0;
  for (int i = 1; i <= 30; ++i) {  // a truck fills the view and rolls on with us
    const StepInTime unseen = step(StepStatus::kNoMotion, 10.0 + 0.1 * i, 0.0);
    metric += scale.length_of(unseen, {}).metric ? 1 : 0;
  }
  EXPECT_LE(metric, 2) << "an instant, while braking could have ended in a rest";
}

TEST(Scale, ARestWhoseRoadMovesIsNone) {
  Scale scale = driving();
  const StepLength length =
      scale.length_of(rest(MeasuredTravel{0.95, 0.03, LengthSource::kRoadImage, true}), {});
  EXPECT_EQ(length.length, 0.95);
  EXPECT_EQ(length.source, LengthSource::kRoadImage);
  EXPECT_TRUE(length.metric);
}

TEST(Scale, NoCarStopsFromTenMetresASecondBetweenTwoImages) {
  Scale scale = driving();
  const StepLength length = scale.length_of(rest({}), {});
  EXPECT_NEAR(length.length, 1.0, 1e-9);
  EXPECT_EQ(length.source, LengthSource::kHeld);
  EXPECT_FALSE(length.metric);
}

TEST(Scale, ARestTooSoonAfterMotionIsNotMetric) {
  Scale scale = driving();
  StepInTime next = rest(MeasuredTravel{0.001, 0.004, LengthSource::kRoadImage, true});
  next.resting = 0.9;
  EXPECT_FALSE(scale.length_of(next, {}).metric) << "dead pixels, a bonnet";
}

TEST(Scale, DoesNotBelieveALengthThatNeedsMoreThanTyres) {
  Scale scale = driving();
  const StepInTime next = step(StepStatus::kOk, 10.1, 1.0);
  const StepLength length = scale.length_of(next, {{0.3, 0.01, LengthSource::kRoad, 50}});
  EXPECT_NEAR(length.length, 1.0, 1e-9);
  EXPECT_EQ(length.source, LengthSource::kHeld);
}

/// Stamps that a recorder made up: images are missing between them.
TEST(Scale, InertiaAloneTellsNoMetresBesideImagesThatContradictIt) {
  Scale scale = driving();
  const StepLength doubted =
      scale.length_of(step(StepStatus::kOk, 10.1, 1.0), {{2.0, 0.01, LengthSource::kRoad, 50}});
  EXPECT_EQ(doubted.source, LengthSource::kHeld);
  EXPECT_FALSE(doubted.metric);
  EXPECT_EQ(doubted.sigma, 0.0);
  const StepLength after = scale.length_of(step(StepStatus::kOk, 10.2, 1.0), {});
  EXPECT_FALSE(after.metric) << "nobody has measured since";
  const StepLength measured =
      scale.length_of(step(StepStatus::kOk, 10.3, 1.0), {{1.02, 0.01, LengthSource::kRoad, 50}});
  EXPECT_TRUE(measured.metric);
  EXPECT_TRUE(scale.length_of(step(StepStatus::kOk, 10.4, 1.0), {}).metric) << "as before";
}

TEST(Scale, BelievesWhatContradictsTheSpeedForHalfASecond) {
  Scale scale = driving();
  StepLength length;
  for (int i = 1; i < 8; ++i) {
    length = scale.length_of(step(StepStatus::kOk, 10.0 + 0.1 * i, 1.0),
                             {{0.3, 0.01, LengthSource::kRoad, 50}});
  }
  EXPECT_EQ(length.length, 0.3) << "the speed was wrong";
  EXPECT_TRUE(length.metric);
}

TEST(Scale, RoadAndMapThatDisagreeRefuteTheMap) {
  Scale scale = driving();
  static_cast<void>(scale.correct({road(1.0, 1.0), {}}, {}, kFocal));
  for (int i = 1; i < 6; ++i) {
    StepInTime next = step(StepStatus::kOk, 10.0 + 0.1 * i, 1.0);
    next.direct = MeasuredTravel{1.0, 0.03, LengthSource::kRoadImage, true};
    const StepLength length = scale.length_of(next, {carried(0.1)});
    EXPECT_EQ(length.length, 1.0) << "the map lost its scale";
    EXPECT_EQ(scale.map_is_refuted(), i >= 5) << i << ' ' << length.conflict;
  }
}

/// Landmarks of a far scene that told each of five steps by so much; they were a metre long.
ScaleCorrection after_five_steps(double told, Scale& scale) {
  for (int i = 1; i <= 5; ++i) {
    static_cast<void>(scale.length_of(step(StepStatus::kOk, 10.0 + 0.1 * i, 1.0), {carried(told)}));
  }
  return scale.correct({road(5.0, 5.0), {}}, {}, kFocal);
}

TEST(Scale, AMapWhoseStepsDoNotAddUpToItsWayGetsNoScale) {
  Scale scale = driving();
  EXPECT_TRUE(after_five_steps(0.95, scale).metric);
  EXPECT_TRUE(scale.is_metric());
  scale = driving();
  const ScaleCorrection correction = after_five_steps(0.15, scale);
  EXPECT_EQ(correction.factor, 1.0);
  EXPECT_FALSE(correction.metric) << "the road measured the way, not what the landmarks carry";
  EXPECT_FALSE(scale.is_metric());
  EXPECT_TRUE(scale.map_is_refuted());
}

TEST(Scale, LooksForTheRoadOfAHighCameraInItsOwnLane) {
  // A row of parked cars, 3.6 m to the right, their sills half a metre above a smooth road.
  FrontEndOptions high = by("height");
  high.camera_height = 2.6;
  SceneGenerator random(4);
  const RelativePose T{Eigen::Matrix3d::Identity(), {0.0, 0.0, -0.9}};
  TwoView seen;
  seen.status = StepStatus::kOk;
  seen.pose = {T.R, {0.0, 0.0, -1.0}};
  seen.focal_px = kFocal;
  for (int i = 0; i < 60; ++i) {
    const double z = random.uniform(7.0, 14.0);
    const Eigen::Vector2d x1(3.6 / z, 2.1 / z);
    const auto ac = correspondence_from_homography(
        plane_induced_homography(T, {Eigen::Vector3d::UnitY(), 2.1}), x1);
    ASSERT_TRUE(ac);
    seen.pair.correspondences.emplace_back();
    static_cast<AffineCorrespondence&>(seen.pair.correspondences.back()) = *ac;
  }
  seen.inliers.assign(seen.pair.size(), true);
  EXPECT_TRUE(started(high).measure(seen, std::nullopt, {}, kAhead).empty());
}

/// A drive in metres, map and road.
Scale mapped() {
  Scale scale = driving();
  static_cast<void>(scale.correct({road(1.0, 1.0), {}}, {}, kFocal));
  return scale;
}

/// A step between images that were dropped: map and road say twice the way.
StepLength after_a_gap(Scale& scale, double begin_s, double by_map, double by_road) {
  StepInTime next = step(StepStatus::kOk, begin_s, 1.0);
  next.direct = MeasuredTravel{by_road, 0.03, LengthSource::kRoadImage, true};
  return scale.length_of(next, {carried(by_map)});
}

TEST(Scale, MapAndRoadTogetherAreBelievedAgainstStamps) {
  Scale scale = mapped();
  const StepLength agreed = after_a_gap(scale, 10.1, 2.02, 2.0);
  EXPECT_TRUE(agreed.metric);
  EXPECT_NEAR(agreed.length, 2.01, 0.02);
  EXPECT_TRUE(agreed.beside_stamps);
  const StepLength apart = after_a_gap(scale, 10.2, 2.0, 2.5);
  EXPECT_FALSE(apart.metric) << "two that disagree prove nothing";
  StepInTime next = step(StepStatus::kOk, 10.3, 1.0);
  EXPECT_FALSE(scale.length_of(next, {carried(2.0)}).metric) << "nor does one alone";
}

TEST(Scale, AStepBesideItsStampTellsNoSpeed) {
  Scale scale = mapped();
  static_cast<void>(after_a_gap(scale, 10.1, 2.02, 2.0));
  const auto expected = scale.expected(10.2, 10.3);
  ASSERT_TRUE(expected);
  EXPECT_NEAR(expected->length, 1.0, 0.05);
}

TEST(Scale, StampsThatAreWrongAgainAndAgainSilenceInertia) {
  Scale scale = mapped();
  const auto goes_on = [&](double begin_s) {
    return scale.length_of(step(StepStatus::kOk, begin_s, 1.0), {});
  };
  EXPECT_TRUE(goes_on(10.1).metric);
  for (const double begin_s : {10.2, 10.4, 10.6}) {
    EXPECT_FALSE(scale.stamps_are_wrong());
    EXPECT_TRUE(after_a_gap(scale, begin_s, 2.02, 2.0).metric);
    EXPECT_TRUE(after_a_gap(scale, begin_s + 0.1, 1.01, 1.0).metric);
  }
  EXPECT_TRUE(scale.stamps_are_wrong());
  EXPECT_FALSE(goes_on(10.8).metric);
}

TEST(Scale, InertiaAloneDoesNotMeasureTheMap) {
  Scale scale = driving();
  KeyframePair without_road = road(2.0, 2.0);
  without_road.acs.clear();
  ASSERT_TRUE(scale.length_of(step(StepStatus::kOk, 10.1, 1.0), {}).metric);
  static_cast<void>(scale.correct({without_road, {}}, {}, kFocal));
  EXPECT_GT(scale.uncertainty(), 0.1);
}

TEST(Scale, RoadThatLiesFarAheadIsTrustedLess) {
  const auto sigma_with = [](double reach) {
    Scale scale = started(by("height"));
    LengthMeasurement told{1.0, 0.01, LengthSource::kRoad, 50};
    told.reach = reach;
    return scale.length_of(step(StepStatus::kOk, 10.0, 1.0), {told}).sigma;
  };
  const double usual = std::hypot(0.01, FrontEndOptions{}.scale.road_uncertainty);
  EXPECT_NEAR(sigma_with(0.0), usual, 1e-12) << "one stretch of road";
  EXPECT_NEAR(sigma_with(7.0), usual, 1e-12) << "what cameras usually see";
  EXPECT_NEAR(sigma_with(11.3), std::hypot(usual, 0.02 * std::sqrt(3.0)), 1e-3);
  Scale by_speed = started(by("gps"));
  LengthMeasurement far{1.0, 0.01, LengthSource::kRoad, 50};
  far.reach = 12.0;
  EXPECT_EQ(by_speed.length_of(step(StepStatus::kOk, 10.0, 1.0), {far}).sigma, 0.01);
}

TEST(Scale, ACameraInDoubtMakesLengthsByImagesUnsureAndNotSpeeds) {
  Scale scale = mapped();
  const StepLength before = scale.length_of(step(StepStatus::kOk, 10.1, 1.0), {carried(1.0)});
  scale.doubt_camera(0.03);
  const StepLength doubted = scale.length_of(step(StepStatus::kOk, 10.2, 1.0), {carried(1.0)});
  EXPECT_TRUE(doubted.metric);
  EXPECT_NEAR(doubted.sigma, std::hypot(before.sigma, 0.03), 1e-3);
  EXPECT_NEAR(doubted.sigma_m, doubted.sigma * doubted.length, 1e-9);
  EXPECT_EQ(doubted.camera_doubt, 0.03);
  scale.doubt_camera(0.07);
  EXPECT_FALSE(scale.length_of(step(StepStatus::kOk, 10.3, 1.0), {carried(1.0)}).metric);
  EXPECT_FALSE(scale.correct({road(1.0, 1.0), {}}, {}, kFocal).metric);
  Scale creeping = mapped();
  creeping.doubt_camera(0.01);
  StepInTime slow = step(StepStatus::kOk, 13.1, 0.01);
  LengthMeasurement creep = carried(0.013);
  creep.sigma = 0.08;
  EXPECT_TRUE(creeping.length_of(slow, {creep}).metric) << "a millimetre of a creep";
  Scale by_speed = started(by("gps"));
  by_speed.doubt_camera(0.07);
  EXPECT_EQ(by_speed.camera_doubt(), 0.0);
}

TEST(Scale, FarLandmarksThatATurnMayHaveShiftedYieldToTheRoad) {
  StepInTime next = step(StepStatus::kOk, 10.1, 1.0);
  next.direct = MeasuredTravel{0.95, 0.02, LengthSource::kRoadImage, true};
  LengthMeasurement far = carried(1.08);
  far.turn_sigma = 0.08;
  Scale scale = mapped();
  const StepLength together = scale.length_of(next, {far});
  EXPECT_TRUE(together.metric);
  EXPECT_EQ(together.source, LengthSource::kRoadImage);
  EXPECT_LT(together.length, 0.98);
  Scale sure = mapped();
  EXPECT_NEAR(sure.length_of(next, {carried(1.0)}).length, 1.0, 1e-9) << "near ones do not";
}

/// Landmarks on a car ahead shrank a few per cent a step, and the mean carried the speed along.
TEST(Scale, TheMeanOfTwoThatDisagreeIsLessSure) {
  const auto beside_road = [](double by_map) {
    StepInTime next = step(StepStatus::kOk, 10.1, 1.0);
    next.direct = MeasuredTravel{1.0, 0.06, LengthSource::kRoadImage, true};
    LengthMeasurement unsure = carried(by_map);
    unsure.sigma = 0.04;
    Scale scale = mapped();
    return scale.length_of(next, {unsure});
  };
  ASSERT_TRUE(beside_road(0.98).metric);
  EXPECT_GT(beside_road(0.82).sigma_m, 1.3 * beside_road(0.98).sigma_m);
}

TEST(Scale, InertiaThatDisagreesDoesNotMakeALengthSurer) {
  const auto helped = [](double by_map) {
    LengthMeasurement unsure = carried(by_map);
    unsure.sigma = 0.06;
    Scale scale = mapped();
    return scale.length_of(step(StepStatus::kOk, 10.1, 1.0), {unsure});
  };
  ASSERT_TRUE(helped(0.98).metric);
  EXPECT_GT(helped(0.88).sigma_m, 1.2 * helped(0.98).sigma_m);
  EXPECT_FALSE(helped(0.82).metric) << "nor does the speed alone tell it then";
}

TEST(Scale, InertiaHelpsALengthThatIsTooUnsureToBeMetric) {
  LengthMeasurement far = carried(1.05);
  far.turn_sigma = 0.1;
  Scale scale = mapped();
  const StepLength helped = scale.length_of(step(StepStatus::kOk, 10.1, 1.0), {far});
  EXPECT_TRUE(helped.metric);
  EXPECT_LT(helped.length, 1.03);
  ASSERT_TRUE(helped.without_inertia.has_value());
  EXPECT_NEAR(helped.without_inertia->length, 1.05, 1e-9) << "the speed learns this alone";
}

/// The map's poses and landmarks stay of one scale while it is not known well enough.
TEST(Scale, AMapThatIsUnsureGoesOnWithItsOwnLengths) {
  Scale scale = mapped();
  LengthMeasurement unsure = carried(1.0);
  unsure.sigma = 0.02;
  static_cast<void>(scale.length_of(step(StepStatus::kOk, 10.1, 1.0), {unsure}));
  KeyframePair without_road = road(1.0, 1.0);
  without_road.acs.clear();
  static_cast<void>(scale.correct({without_road, {}}, {}, kFocal));
  ASSERT_FALSE(scale.is_metric());
  for (int i = 2; i <= 20; ++i) {
    unsure.length = 1.0 + 0.03 * i;
    const StepLength used = scale.length_of(step(StepStatus::kOk, 10.0 + 0.1 * i, 1.0), {unsure});
    EXPECT_FALSE(used.metric && used.source == LengthSource::kMap);
    if (i < 10) continue;  // the speed is still known better
    EXPECT_EQ(used.length, unsure.length);
    EXPECT_EQ(used.source, LengthSource::kMap);
  }
}

TEST(Scale, CreepingDoesNotLoseTheScale) {
  Scale scale = mapped();
  for (int i = 1; i <= 60; ++i) {
    LengthMeasurement creep = carried(0.02);
    creep.sigma = 0.2;
    static_cast<void>(scale.length_of(step(StepStatus::kOk, 10.0 + 0.1 * i, 0.02), {creep}));
  }
  static_cast<void>(scale.correct({road(1.2, 0.0), {}}, {}, kFocal));
  EXPECT_TRUE(scale.is_metric());
}

TEST(Scale, ACreepStatesItsSigmaInProportionHoweverShort) {
  Scale scale = started(by("height"));
  const double way = 0.004;
  for (int i = 0; i < 5; ++i) {
    const StepInTime next = step(StepStatus::kOk, 10.0 + 0.1 * i, way);
    static_cast<void>(scale.length_of(next, {{way, 0.5, LengthSource::kRoad, 50}}));
  }
  LengthMeasurement unsure{way, 1.5, LengthSource::kRoad, 50};
  const StepLength creep = scale.length_of(step(StepStatus::kOk, 10.5, way), {unsure});
  ASSERT_TRUE(creep.metric);
  ASSERT_TRUE(creep.without_inertia.has_value());
  EXPECT_NEAR(creep.sigma * creep.length, creep.sigma_m, 1e-3 * creep.sigma_m);
}

TEST(ShutterClock, TakesARegularShutterForGrantedBesideStampsThatJitter) {
  ShutterClock clock;
  EXPECT_EQ(clock.between(0.08).half_range, 0.0) << "nothing is known yet";
  clock.tell(0.05);
  EXPECT_GT(clock.between(0.022).half_range, 0.01) << "one of the two jitters";
  EXPECT_LT(clock.between(0.05).half_range, 1e-9);
  for (int i = 0; i < 10; ++i) clock.tell(i % 2 == 0 ? 0.051 : 0.049);
  const StepTime late = clock.between(0.078);  // 1.5 intervals: one or two
  EXPECT_NEAR(late.least(), 0.05, 2e-3);
  EXPECT_NEAR(late.most(), 0.1, 3e-3);
  const StepTime early = clock.between(0.022);
  EXPECT_NEAR(early.least(), 0.022, 1e-9);
  EXPECT_NEAR(early.most(), 0.05, 2e-3);
  EXPECT_LT(clock.between(0.1).half_range, 2e-3) << "one image was left out";
}

TEST(Inertia, AllowsTheStepOfARegularShutterWhateverTheStampSays) {
  Inertia inertia({}, 2.0);
  for (int i = 0; i < 10; ++i) {
    inertia.tick(0.05 * i, 0.05 * (i + 1));
    inertia.tell(0.05 * i, 0.05 * (i + 1), 0.25, 0.003);
  }
  const auto expected = inertia.expect(0.5, 0.578);
  ASSERT_TRUE(expected.has_value());
  EXPECT_TRUE(expected->allows(0.25, 0.003));
  EXPECT_TRUE(expected->allows(0.39, 0.003));
  EXPECT_FALSE(expected->allows(0.1, 0.003));
}

TEST(Inertia, KnowsWhatTheLengthsThatTaughtItShare) {
  Inertia inertia({}, 2.0);
  for (int i = 0; i < 20; ++i) inertia.tell(0.1 * i, 0.1 * (i + 1), 1.0, 0.02, 0.05);
  const auto expected = inertia.expect(2.0, 2.1);
  ASSERT_TRUE(expected.has_value());
  EXPECT_LT(expected->sigma, 0.04) << "twenty lengths average out ...";
  EXPECT_NEAR(expected->common, 0.05, 1e-3) << "... but for what they share";
}

TEST(Inertia, ExpectsNothingBeforeASpeedWasTold) {
  EXPECT_FALSE(Inertia({}, 2.0).expect(0.0, 0.1));
}

TEST(Inertia, IsLessSureTheLongerAgo) {
  Inertia inertia({}, 2.0);
  inertia.tell(0.0, 0.1, 1.0, 0.01);
  const auto soon = inertia.expect(0.1, 0.2);
  const auto late = inertia.expect(1.1, 1.2);
  ASSERT_TRUE(soon && late);
  EXPECT_NEAR(soon->length, 1.0, 1e-9);
  EXPECT_LT(5.0 * soon->sigma, late->sigma);
  EXPECT_LT(late->least, soon->least);
  EXPECT_FALSE(inertia.expect(5.0, 5.1)) << "too long ago";
}

TEST(Scale, RefusesTheLengthOfAFlyingCar) {
  Scale scale = started(by("height"));
  const StepLength length =
      scale.length_of(step(StepStatus::kOk, 100.0, 1.2), {{8.0, 0.01, LengthSource::kRoad, 50}});
  EXPECT_FALSE(length.metric) << "80 m/s";
  EXPECT_EQ(length.source, LengthSource::kHeld);
  EXPECT_EQ(length.length, 1.2);
  EXPECT_EQ(length.ground_acs, 50U);
}

TEST(Scale, SaysWhenALengthIsThatOfAFlyingCar) {
  Scale scale = driving();
  const StepLength length =
      scale.length_of(step(StepStatus::kOk, 10.1, 1.0), {{9.0, 0.01, LengthSource::kRoad, 50}});
  EXPECT_TRUE(length.too_fast);
  EXPECT_FALSE(
      scale.length_of(step(StepStatus::kOk, 10.2, 1.0), {{3.0, 0.01, LengthSource::kRoad, 50}})
          .too_fast)
      << "inertia refuses it, but cars drive as fast";
}

TEST(Scale, HoldsTheLastMetricSpeedForAWhile) {
  FrontEndOptions options = by("height");
  options.max_hold = 1.0;
  Scale scale = started(options);
  EXPECT_EQ(scale.length_of(step(StepStatus::kOk, 9.9, 0.0), {}).length, 1.0)
      << "the unit of a map without metres";
  static_cast<void>(
      scale.length_of(step(StepStatus::kOk, 10.0, 1.0), {{0.8, 0.01, LengthSource::kRoad, 50}}));
  const StepLength held = scale.length_of(step(StepStatus::kPredicted, 10.1, 0.3), {});
  EXPECT_NEAR(held.length, 0.8, 1e-9);
  EXPECT_FALSE(held.metric);
  EXPECT_EQ(held.source, LengthSource::kHeld);
  EXPECT_EQ(scale.length_of(step(StepStatus::kPredicted, 12.0, 0.3), {}).length, 0.3)
      << "too long ago: the last step goes on";
}

TEST(Scale, TakesTheHeightOfAMountThatStandsOnTheRoad) {
  FrontEndOptions options = by("height");
  options.camera_height = 0.0;
  CameraFrame frame;
  frame.T_vehicle_cam.translation().z() = 1.2;
  Scale scale(options);
  scale.start(frame);
  EXPECT_EQ(scale.camera_height(), 1.2);
  frame.T_vehicle_cam.translation().z() = 0.3;
  Scale low(options);
  low.start(frame);
  EXPECT_EQ(low.camera_height(), 0.0) << "relative to the vehicle, not to the road";
  options.scale.source = "gps";
  options.camera_height = 1.5;
  Scale by_speed(options);
  by_speed.start(frame);
  EXPECT_EQ(by_speed.camera_height(), 0.0) << "the road is not asked";
}

TEST(Scale, MeasuresTheMapBySpeeds) {
  Scale scale = started(by("gps"));
  for (int i = 0; i < 12; ++i) {
    static_cast<void>(scale.length_of(step(StepStatus::kOk, 0.1 * i, 1.0), {carried(2.0)}));
  }
  scale.add_speed({0.0, 10.0});
  scale.add_speed({1.0, 10.0});
  const ScaleCorrection correction = scale.correct({road(12.0, 24.0), {}}, {}, kFocal);
  EXPECT_NEAR(correction.factor, 0.5, 1e-6);
  EXPECT_TRUE(correction.metric);
  EXPECT_EQ(correction.ground_acs, 0U);
}

TEST(Scale, MeasuresTheMapByDepths) {
  Scale scale = started(by("stereo"));
  MapLengths map;
  for (int i = 0; i < 30; ++i) map.depths.push_back({10.0 + i, 0.02, {0.4 * (10.0 + i), 0.01}});
  const ScaleCorrection correction = scale.correct(map, {}, kFocal);
  EXPECT_NEAR(correction.factor, 0.4, 1e-6);
  EXPECT_TRUE(correction.metric);
}

TEST(ScaleByDepths, NeedsEnoughThatAgree) {
  std::vector<DepthComparison> depths(7, {10.0, 0.02, {5.0, 0.01}});
  EXPECT_FALSE(scale_by_depths(depths, 8).has_value());
  depths.push_back({-1.0, 0.02, {5.0, 0.01}});
  EXPECT_FALSE(scale_by_depths(depths, 8).has_value()) << "behind the camera";
  depths.push_back({10.0, 0.02, {5.0, 0.01}});
  const auto scale = scale_by_depths(depths, 8);
  ASSERT_TRUE(scale.has_value());
  EXPECT_NEAR(scale->ratio, 0.5, 1e-9);
  EXPECT_GE(scale->sigma, 0.01) << "rectification does not average out";
  EXPECT_FALSE(scale_by_depths({}, 0).has_value());
}

}  // namespace
}  // namespace oneac
