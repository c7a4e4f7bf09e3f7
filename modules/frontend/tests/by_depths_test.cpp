#include "two_view/by_depths.h"

#include "oneac/geometry/angular_errors.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace oneac {
namespace {

constexpr double kFocal = 600.0;
constexpr double kThreshold_px = 1.0;

/// What a camera sees that moves by T_2_1 [m] in a street, and how the points of it go.
class Street {
 public:
  explicit Street(RelativePose T_2_1) : T_2_1_(T_2_1) { seen_.focal_px = kFocal; }

  /// Points in the box, in the first view, which themselves move by `own` [m] in the step.
  Street& with(int count, const Eigen::Vector3d& low, const Eigen::Vector3d& high, bool near,
               const Eigen::Vector3d& own = Eigen::Vector3d::Zero()) {
    for (int i = 0; i < count; ++i) {
      Eigen::Vector3d X;
      for (int k = 0; k < 3; ++k) X(k) = random_.uniform(low(k), high(k));
      const Eigen::Vector3d X2 = T_2_1_.R * (X + own) + T_2_1_.t;
      Correspondence ac;
      ac.x1 = X.hnormalized();
      ac.x2 =
          X2.hnormalized() +
          0.15 / kFocal * Eigen::Vector2d(random_.uniform(-1.0, 1.0), random_.uniform(-1.0, 1.0));
      ac.point_sigma = 0.1 / kFocal;
      seen_.pair.correspondences.push_back(ac);
      depths_.emplace_back();
      if (near) depths_.back() = MeasuredDepth{X2.z() * random_.uniform(0.98, 1.02), 0.02};
    }
    return *this;
  }
  Street& with_houses() { return with(200, {-25, -1, 40}, {25, 1.5, 120}, false); }
  Street& with_road() { return with(15, {-3, 1.2, 6}, {3, 1.5, 20}, true); }

  [[nodiscard]] TwoView by_depths(TwoView told) const {
    told.pair = seen_.pair;
    told.focal_px = kFocal;
    TwoViewPrior prior;
    prior.course = {-Eigen::Vector3d::UnitZ(), 0.05};
    return creeping_by_depths(std::move(told), depths_, prior, kThreshold_px);
  }

 private:
  RelativePose T_2_1_;
  TwoView seen_;
  PointDepths depths_;
  SceneGenerator random_{11};
};

RelativePose ahead(double metres) {
  return {Eigen::Matrix3d::Identity(), {0.0, 0.0, -metres}};
}

/// Two views that took the car which crosses for the world.
TwoView sideways() {
  TwoView told;
  told.status = StepStatus::kOk;
  told.pose.t = Eigen::Vector3d::UnitX();
  return told;
}

/// Two views that know their direction to 1 mrad, ahead and by so much downwards [rad].
TwoView sure_of(double down) {
  TwoView told;
  told.status = StepStatus::kOk;
  told.pose.t = Eigen::Vector3d(0.0, down, -1.0).normalized();
  told.covariance.setIdentity();
  told.covariance *= 1e-6;
  return told;
}

TEST(CreepingByDepths, LeavesTheWayToTwoViewsThatSayTheSameAndAreSurer) {
  Street street(ahead(0.16));
  street.with_houses().with_road();
  EXPECT_EQ(street.by_depths(sure_of(0.01)).pose.t, sure_of(0.01).pose.t);
  EXPECT_LT(direction_error(street.by_depths(sure_of(0.5)).pose.t, ahead(1.0).t), 0.1)
      << "not the same";
}

TEST(CreepingByDepths, FindsTheWayAheadBehindACarThatCrosses) {
  for (const double metres : {0.02, 0.07}) {
    Street street(ahead(metres));
    street.with_houses().with_road().with(60, {-4, 0, 8}, {4, 1.2, 9}, true, {0.3, 0, 0});
    const TwoView seen = street.by_depths(sideways());
    EXPECT_EQ(seen.status, StepStatus::kOk) << metres;
    EXPECT_LT(direction_error(seen.pose.t, ahead(1.0).t), 0.15) << metres;
    EXPECT_LT(rotation_error(seen.pose.R, Eigen::Matrix3d::Identity()), 0.001) << metres;
    EXPECT_GT(seen.covariance.trace(), 0.0);
    EXPECT_GT(seen.inlier_count, 200U);
    EXPECT_LT(seen.inlier_count, 230U) << "the car is no inlier";
  }
}

TEST(CreepingByDepths, FindsTheRestBehindACarThatCrosses) {
  Street street(ahead(0.0));
  street.with_houses().with_road().with(60, {-4, 0, 8}, {4, 1.2, 9}, true, {0.3, 0, 0});
  const TwoView seen = street.by_depths(sideways());
  EXPECT_EQ(seen.status, StepStatus::kNoMotion);
  EXPECT_EQ(seen.pose.t.norm(), 0.0);
}

TEST(CreepingByDepths, FindsAWayBackwards) {
  const TwoView seen = Street(ahead(-0.06)).with_houses().with_road().by_depths(sideways());
  ASSERT_EQ(seen.status, StepStatus::kOk);
  EXPECT_LT(direction_error(seen.pose.t, -ahead(1.0).t), 0.15);
}

TEST(CreepingByDepths, LeavesALongStepToItsTwoViews) {
  const TwoView seen = Street(ahead(0.5)).with_houses().with_road().by_depths(sideways());
  EXPECT_EQ(seen.pose.t, sideways().pose.t);
}

TEST(CreepingByDepths, DoesNotTakeABusForTheWorld) {
  Street street(ahead(0.0));
  street.with(300, {-6, -2, 7}, {6, 1.2, 8}, true, {0.15, 0, 0}).with_road();
  const TwoView seen = street.by_depths(sideways());
  EXPECT_EQ(seen.pose.t, sideways().pose.t) << "as it was told";
}

TEST(CreepingByDepths, NeedsNearPointsThatAgree) {
  const TwoView seen = Street(ahead(0.05)).with_houses().by_depths(sideways());
  EXPECT_EQ(seen.pose.t, sideways().pose.t);
}

}  // namespace
}  // namespace oneac
