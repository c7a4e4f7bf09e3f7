#include "two_view/sense_of_travel.h"

#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <utility>

namespace oneac {
namespace {

constexpr double kFocal = 700.0;
const Eigen::Vector3d kAhead = -Eigen::Vector3d::UnitZ();  // t of a car that drives on

/// A car that goes on by a metre, but was found to go back, in a scene that begins so far away [m].
TwoView found_in_reverse(double nearest, double noise_px) {
  SceneGenerator random(5);
  TwoView found;
  found.status = StepStatus::kOk;
  found.pose = {Eigen::Matrix3d::Identity(), -kAhead};
  found.focal_px = kFocal;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector2d x1(random.uniform(-0.5, 0.5), random.uniform(-0.3, 0.3));
    const Eigen::Vector3d X = random.uniform(1.0, 1.5) * nearest * x1.homogeneous();
    Correspondence ac;
    ac.x1 = x1;
    ac.x2 = (X + kAhead).hnormalized();
    ac.x2.x() += random.normal(noise_px / kFocal);
    ac.x2.y() += random.normal(noise_px / kFocal);
    found.pair.correspondences.push_back(ac);
  }
  found.inliers.assign(found.pair.size(), true);
  found.covariance(0, 4) = found.covariance(4, 0) = 1e-6;
  return found;
}

/// The same that goes back indeed.
TwoView reversing() {
  TwoView found = found_in_reverse(8.0, 0.1);
  for (Correspondence& ac : found.pair.correspondences) std::swap(ac.x1, ac.x2);
  return found;
}

TEST(SenseOfTravel, OfFarSceneryIsThatOfTheStepBefore) {
  const TwoView found = in_lasting_sense(found_in_reverse(50000.0, 0.2), kAhead);
  EXPECT_EQ(found.pose.t, kAhead);
  EXPECT_EQ(found.covariance(0, 4), -1e-6) << "of (w, v), and v turned with t";
}

TEST(SenseOfTravel, OfNearSceneryIsItsOwn) {
  EXPECT_EQ(in_lasting_sense(reversing(), kAhead).pose.t, -kAhead);
}

TEST(SenseOfTravel, BeforeAnythingIsKnownIsThatOfTheImages) {
  EXPECT_EQ(in_lasting_sense(found_in_reverse(50000.0, 0.2), Eigen::Vector3d::Zero()).pose.t,
            -kAhead);
}

}  // namespace
}  // namespace oneac
