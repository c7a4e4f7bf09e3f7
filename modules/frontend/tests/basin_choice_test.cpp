#include "two_view/basin_choice.h"

#include "two_view/course.h"

#include "oneac/geometry/angles.h"
#include "oneac/geometry/angular_errors.h"
#include "oneac/geometry/homography.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace oneac {
namespace {

constexpr double kFocal = 400.0;
constexpr double kThreshold_px = 0.25;
const RelativePose kAhead{Eigen::Matrix3d::Identity(), {0.0, 0.0, -1.0}};

void add(const RelativePose& T, const Plane& plane, const Eigen::Vector2d& x1, double noise_px,
         SceneGenerator& random, TrackedPair& pair) {
  const auto ac = correspondence_from_homography(plane_induced_homography(T, plane), x1);
  if (!ac) return;
  Correspondence full;
  static_cast<AffineCorrespondence&>(full) = *ac;
  full.x2 += noise_px / kFocal * Eigen::Vector2d(random.uniform(-1, 1), random.uniform(-1, 1));
  pair.correspondences.push_back(full);
}

/// Clouds alone: one plane above, whose second homography points up.
TrackedPair clouds(double height) {
  SceneGenerator random(11);
  TrackedPair pair;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector2d x1(random.uniform(-0.6, 0.6), random.uniform(-0.5, -0.1));
    add(kAhead, {-Eigen::Vector3d::UnitY(), height}, x1, 0.05, random, pair);
  }
  return pair;
}

/// Road and a house front: near, so that every direction is told.
TrackedPair street() {
  SceneGenerator random(12);
  TrackedPair pair;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector2d road(random.uniform(-0.5, 0.5), random.uniform(0.1, 0.5));
    add(kAhead, {Eigen::Vector3d::UnitY(), 1.5}, road, 0.05, random, pair);
    const Eigen::Vector2d wall(random.uniform(0.1, 0.6), random.uniform(-0.3, 0.1));
    add(kAhead, {Eigen::Vector3d::UnitX(), 4.0}, wall, 0.05, random, pair);
  }
  return pair;
}

TwoView choose(TwoView seen, const Course& course) {
  const std::vector<bool> all(seen.pair.size(), true);
  return in_likelier_basin(std::move(seen), all, course, {}, kThreshold_px);
}

TwoView found(TrackedPair pair, const Eigen::Vector3d& direction) {
  TwoView seen;
  seen.status = StepStatus::kOk;
  seen.pose = {Eigen::Matrix3d::Identity(), direction.normalized()};
  seen.focal_px = kFocal;
  seen.covariance.setIdentity();
  seen.covariance *= 1e-6;
  seen.inliers.assign(pair.size(), true);
  seen.inlier_count = pair.size();
  seen.pair = std::move(pair);
  return seen;
}

double direction_sigma(const TwoView& seen) {
  return std::sqrt(seen.covariance.bottomRightCorner<3, 3>().trace());
}

TEST(BasinChoice, APlaneOfCloudsIsSeenFromTheCourse) {
  const Eigen::Vector3d up(0.0, 0.9, -0.4);  // near the second homography
  const TwoView seen = choose(found(clouds(60.0), up), {kAhead.t, 0.05});
  EXPECT_LT(direction_error(seen.pose.t, kAhead.t), 3.0 * kDegree);
  EXPECT_GT(seen.inlier_count, seen.pair.size() * 9 / 10);
}

TEST(BasinChoice, SaysThatItIsUnsureWhereACourseHardlyPrefersOneOfTwo) {
  const auto sigma_by = [](double course_sigma) {
    const Eigen::Vector3d up(0.0, 0.9, -0.4);
    return direction_sigma(choose(found(clouds(60.0), up), {kAhead.t, course_sigma}));
  };
  EXPECT_GT(sigma_by(0.5), 4.0 * kDegree);
  EXPECT_GT(sigma_by(0.5), 3.0 * sigma_by(0.05));
}

TEST(BasinChoice, TheImagesDecideWhereTheyTell) {
  const Course wrong{Eigen::Vector3d(-0.35, 0.0, -0.94).normalized(), 0.05};
  const TwoView seen = choose(found(street(), kAhead.t), wrong);
  EXPECT_LT(direction_error(seen.pose.t, kAhead.t), 0.3 * kDegree) << "a car that skids";
  EXPECT_LT(direction_sigma(seen), 0.3 * kDegree);
}

TEST(BasinChoice, LeavesADirectionNearTheCourseAndOneInReverse) {
  const TwoView near = found(clouds(500.0), {0.05, 0.0, -1.0});
  EXPECT_EQ(choose(near, {kAhead.t, 0.05}).pose.t, near.pose.t);
  const TwoView back = found(street(), {0.0, 0.0, 1.0});
  EXPECT_EQ(choose(back, {kAhead.t, 0.05}).pose.t, back.pose.t);
}

/// Most of the picture is somebody who crosses; the rest is road.
TrackedPair crossed() {
  SceneGenerator random(13);
  const RelativePose crosses{Eigen::Matrix3d::Identity(), {1.0, 0.0, 0.0}};
  TrackedPair pair;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector2d bus(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.1));
    add(crosses, {Eigen::Vector3d::UnitZ(), 8.0}, bus, 0.05, random, pair);
    const Eigen::Vector2d road(random.uniform(-0.5, 0.5), random.uniform(0.15, 0.5));
    if (i < 100) add(kAhead, {Eigen::Vector3d::UnitY(), 1.5}, road, 0.05, random, pair);
  }
  return pair;
}

TEST(BasinChoice, NoNumberOfPointsMakesACarGoSideways) {
  const TwoView seen = choose(found(crossed(), {1.0, 0.0, 0.0}), {kAhead.t, 0.05, true});
  EXPECT_LT(direction_error(seen.pose.t, kAhead.t), 10.0 * kDegree);
  EXPECT_TRUE(seen.kept_on_course);
  EXPECT_TRUE(seen.doubts_course);
}

TEST(BasinChoice, AFewPointsInTheDarkDoNotDoubtTheCourse) {
  TrackedPair few = crossed();
  SceneGenerator random(31);
  few.correspondences.resize(16);
  for (Correspondence& ac : few.correspondences) {
    ac.x2 += Eigen::Vector2d(random.normal(0.05), random.normal(0.05));
  }
  const TwoView seen = choose(found(few, {1.0, 0.0, 0.0}), {kAhead.t, 0.05, true});
  EXPECT_FALSE(seen.doubts_course);
}

TEST(BasinChoice, AMountDoesNotForbidASidewaysCamera) {
  const TwoView seen = choose(found(crossed(), {1.0, 0.0, 0.0}), {kAhead.t, 0.15, false});
  EXPECT_LT(direction_error(seen.pose.t, {1.0, 0.0, 0.0}), 10.0 * kDegree);
  EXPECT_FALSE(seen.kept_on_course);
}

TEST(CourseBelief, GoesByTheMountUntilThreeStepsAreSeen) {
  CourseBelief course;
  course.follow({0.0, 0.1, -0.99});
  const Course now = course.now({0.0, 0.0, -1.0});
  EXPECT_EQ(now.direction, Eigen::Vector3d(0.0, 0.0, -1.0));
  EXPECT_GT(now.sigma, 0.1);
}

TEST(CourseBelief, IsNotTurnedByFewWrongSteps) {
  CourseBelief course;
  for (int i = 0; i < 9; ++i) {
    const bool wrong = i % 3 == 2;
    course.follow(wrong ? Eigen::Vector3d(0.0, 1.0, 0.0) : Eigen::Vector3d(0.01, 0.0, -1.0));
  }
  const Course now = course.now({1.0, 0.0, 0.0});
  EXPECT_LT(direction_error(now.direction, {0.01, 0.0, -1.0}), 0.1 * kDegree);
}

TEST(CourseBelief, BeginsAnewWhereTheImagesContradictItForLong) {
  const Eigen::Vector3d wrong(0.0, 0.0, -1.0), mount(1.0, 0.0, 0.0);
  CourseBelief course;
  for (int i = 0; i < 9; ++i) course.follow(wrong);
  for (int i = 0; i < 5; ++i) course.follow(wrong, true);
  EXPECT_TRUE(course.now(mount).seen);
  course.follow(wrong);
  for (int i = 0; i < 20 && course.now(mount).seen; ++i) course.follow(wrong, true);
  EXPECT_FALSE(course.now(mount).seen);
  EXPECT_EQ(course.now(mount).direction, mount);
}

TEST(CourseBelief, KnowsNothingOfStepsThatContradictEachOther) {
  CourseBelief course;
  course.follow({1.0, 0.0, 0.0});
  course.follow({0.0, 1.0, 0.0});
  course.follow({0.0, 0.0, 1.0});
  EXPECT_EQ(course.now({0.0, 0.0, -1.0}).sigma, 0.0);
}

}  // namespace
}  // namespace oneac
