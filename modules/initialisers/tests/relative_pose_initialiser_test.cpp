#include "oneac/initialisers/relative_pose_initialiser.h"

#include "oneac/base/error.h"
#include "oneac/geometry/angular_errors.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>
#include <mrpt/containers/yaml.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace oneac {
namespace {

std::vector<AffineCorrespondence> street(SceneGenerator& scene, const RelativePose& T) {
  std::vector<AffineCorrespondence> acs;
  acs.reserve(120);
  const Plane ground = scene.ground();
  for (int i = 0; i < 60; ++i) acs.push_back(scene.on_plane(T, ground));
  for (int i = 0; i < 60; ++i) acs.push_back(scene.on_plane(T, scene.any_plane()));
  return acs;
}

TEST(MakeInitialiser, KnowsTheMethodsByShortAndByClassName) {
  for (const char* name : {"1ac_pooled", "1ac_ground", "1ac_planar"}) {
    EXPECT_EQ(make_initialiser(name)->name(), name);
  }
  EXPECT_EQ(make_initialiser("oneac::Initialiser1acGround")->name(), "1ac_ground");
}

TEST(MakeInitialiser, EveryMethodIsReachableThroughMrptsOwnFactory) {
  ASSERT_FALSE(initialiser_names().empty());
  for (const auto& [class_name, name] :
       std::map<std::string, std::string>{{"1acGround", "1ac_ground"},
                                          {"1acSide", "1ac_side"},
                                          {"1acFront", "1ac_front"},
                                          {"1acWall", "1ac_wall"},
                                          {"1acPlanar", "1ac_planar"},
                                          {"1acPooled", "1ac_pooled"},
                                          {"2pcGround", "2pc_ground"},
                                          {"2pcPlanar", "2pc_planar"},
                                          {"3pcVertical", "3pc_vertical"},
                                          {"1pc", "1pc"},
                                          {"5pc", "5pc"},
                                          {"8pc", "8pc"},
                                          {"4pc", "4pc"},
                                          {"2ac", "2ac"},
                                          {"1acVertical", "1ac_vertical"},
                                          {"1acPlanarFocal", "1ac_planar_focal"},
                                          {"2acEssential", "2ac_essential"}}) {
    const auto object = std::dynamic_pointer_cast<RelativePoseInitialiser>(
        mrpt::rtti::classFactory("oneac::Initialiser" + class_name));
    ASSERT_NE(object, nullptr) << class_name;
    EXPECT_EQ(object->name(), name);
    EXPECT_TRUE(object->GetRuntimeClass()->derivedFrom("oneac::RelativePoseInitialiser"));
  }
}

TEST(MakeInitialiser, AMethodsOptionsGoWithItsClone) {
  const auto configured = make_initialiser("5pc");
  configured->configure(mrpt::containers::yaml::FromText("gc_ransac: {min_inliers: 1000}"));
  const std::unique_ptr<mrpt::rtti::CObject> object(configured->clone());
  const auto* clone = dynamic_cast<const RelativePoseInitialiser*>(object.get());
  ASSERT_NE(clone, nullptr);
  SceneGenerator scene(6);
  const auto acs = street(scene, scene.planar_motion());
  EXPECT_EQ(clone->estimate({acs, Eigen::Matrix3d::Identity(), 700.0, 0}).status,
            PoseStatus::kTooFew);
}

TEST(MakeInitialiser, ListsTheNamesWhenOneIsUnknown) {
  try {
    static_cast<void>(make_initialiser("1ac_poled"));
    FAIL() << "must throw";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("did you mean '1ac_pooled'"), std::string::npos) << text;
    EXPECT_NE(text.find("1ac_ground"), std::string::npos) << text;
  }
}

const std::vector<std::string> kMethods = {
    "1ac_ground",   "1ac_side",   "1ac_front",    "1ac_wall",
    "1ac_planar",   "1ac_pooled", "2pc_ground",   "2pc_planar",
    "3pc_vertical", "1pc",        "5pc",          "8pc",
    "4pc",          "2ac",        "1ac_vertical", "1ac_planar_focal",
    "2ac_essential"};

TEST(MakeInitialiser, KnowsEveryMethodOfThePapersTableAndItsRivals) {
  const std::vector<std::string> names = initialiser_names();
  for (const std::string& name : kMethods) {
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
  }
}

/// Planes of every kind the methods ask for; the one-point method asks for circular motion.
std::vector<AffineCorrespondence> town(SceneGenerator& scene, const RelativePose& T) {
  std::vector<AffineCorrespondence> acs;
  const Plane planes[] = {
      scene.ground(), {Eigen::Vector3d::UnitX(), 2.0}, {Eigen::Vector3d::UnitZ(), 6.0}};
  for (const Plane& plane : planes) {
    for (int i = 0; i < 60; ++i) {
      acs.push_back(scene.with_noise(scene.on_plane(T, plane), 1e-4, 1e-3));
    }
  }
  for (int i = 0; i < 60; ++i) {
    acs.push_back(scene.with_noise(scene.on_plane(T, scene.any_plane()), 1e-4, 1e-3));
  }
  return acs;
}

RelativePose circular_motion(double yaw) {
  // The chord of a circle lies half-way between the headings.
  return {yaw_rotation(std::cos(yaw), std::sin(yaw)),
          -Eigen::Vector3d(-std::sin(yaw / 2.0), 0.0, std::cos(yaw / 2.0))};
}

TEST(Initialiser, EveryMethodFindsTheMotionInEachOfItsEstimators) {
  SceneGenerator scene(7);
  const RelativePose truth = circular_motion(0.02);
  const auto acs = town(scene, truth);
  for (const std::string& name : kMethods) {
    const auto initialiser = make_initialiser(name);
    for (const std::string& estimator : initialiser->estimators()) {
      initialiser->configure(mrpt::containers::yaml::FromText("estimator: " + estimator));
      const auto result = initialiser->estimate({acs, Eigen::Matrix3d::Identity(), 700.0, 5});
      ASSERT_EQ(result.status, PoseStatus::kOk) << name << " in " << estimator;
      EXPECT_LT(rotation_error(result.pose.R, truth.R), 2e-3) << name << " in " << estimator;
      EXPECT_LT(direction_error(result.pose.t, truth.t), 2e-2) << name << " in " << estimator;
    }
  }
}

TEST(Initialiser, EveryMethodReportsAStandingCameraAndATurnOnTheSpot) {
  SceneGenerator scene(9);
  const RelativePose turn{yaw_rotation(std::cos(0.05), std::sin(0.05)), Eigen::Vector3d::Zero()};
  std::vector<AffineCorrespondence> still, turned;
  for (int i = 0; i < 100; ++i) {
    still.push_back(
        scene.with_noise(scene.on_plane(RelativePose{}, scene.any_plane()), 1e-4, 1e-3));
    turned.push_back(scene.with_noise(scene.on_plane(turn, scene.any_plane()), 1e-4, 1e-3));
  }
  for (const char* name : {"1ac_pooled", "1ac_ground", "5pc", "8pc", "4pc"}) {
    const auto initialiser = make_initialiser(name);
    const auto stood = initialiser->estimate({still, Eigen::Matrix3d::Identity(), 700.0, 0});
    EXPECT_EQ(stood.status, PoseStatus::kNoMotion) << name;
    const auto spun = initialiser->estimate({turned, Eigen::Matrix3d::Identity(), 700.0, 0});
    EXPECT_EQ(spun.status, PoseStatus::kPureRotation) << name;
    EXPECT_LT(rotation_error(spun.pose.R, turn.R), 1e-3) << name;
  }
}

TEST(Initialiser, RefusesAnEstimatorThatTheMethodCannotRunIn) {
  EXPECT_THROW(
      make_initialiser("5pc")->configure(mrpt::containers::yaml::FromText("estimator: consensus")),
      InputError);
  EXPECT_THROW(make_initialiser("1ac_pooled")
                   ->configure(mrpt::containers::yaml::FromText("estimator: gc_ransac")),
               InputError);
}

TEST(Initialiser, PutsInlierFlagsBackBesideCorrespondencesThatAreNotFinite) {
  SceneGenerator scene(10);
  auto acs = town(scene, circular_motion(0.01));
  acs.insert(acs.begin() + 3, AffineCorrespondence{});
  acs[3].A(0, 0) = std::numeric_limits<double>::quiet_NaN();
  const auto result =
      make_initialiser("5pc")->estimate({acs, Eigen::Matrix3d::Identity(), 700.0, 0});
  ASSERT_EQ(result.inliers.size(), acs.size());
  EXPECT_FALSE(result.inliers[3]);
  EXPECT_TRUE(result.inliers[2]);
  EXPECT_TRUE(result.inliers.back());
}

TEST(Initialiser, TakesItsOptionsFromYaml) {
  SceneGenerator scene(8);
  const auto acs = street(scene, scene.planar_motion());
  const auto initialiser = make_initialiser("1ac_pooled");
  initialiser->configure(mrpt::containers::yaml::FromText("consensus: {min_inliers: 1000}"));
  EXPECT_EQ(initialiser->estimate({acs, Eigen::Matrix3d::Identity(), 700.0, 0}).status,
            PoseStatus::kTooFew);
}

TEST(Initialiser, RefusesUnknownKeysAndValuesOutOfBounds) {
  const auto initialiser = make_initialiser("1ac_pooled");
  EXPECT_THROW(
      initialiser->configure(mrpt::containers::yaml::FromText("consensus: {treshold_px: 1}")),
      InputError);
  EXPECT_THROW(
      initialiser->configure(mrpt::containers::yaml::FromText("consensus: {threshold_px: -1}")),
      InputError);
}

}  // namespace
}  // namespace oneac
