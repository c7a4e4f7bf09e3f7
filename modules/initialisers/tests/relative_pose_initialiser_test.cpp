#include "oneac/initialisers/relative_pose_initialiser.h"

#include "oneac/base/error.h"
#include "oneac/geometry/angular_errors.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>
#include <mrpt/containers/yaml.h>

#include <algorithm>

namespace oneac {
namespace {

std::vector<AffineCorrespondence> street(SceneGenerator& scene, const RelativePose& T) {
  std::vector<AffineCorrespondence> acs;
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

TEST(MakeInitialiser, IsReachableThroughMrptsOwnFactory) {
  ASSERT_FALSE(initialiser_names().empty());
  const auto object = mrpt::rtti::classFactory("oneac::Initialiser1acPooled");
  EXPECT_NE(std::dynamic_pointer_cast<RelativePoseInitialiser>(object), nullptr);
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

TEST(Initialiser, EveryMethodFindsPlanarMotion) {
  SceneGenerator scene(7);
  const RelativePose truth = scene.planar_motion();
  const auto acs = street(scene, truth);
  for (const std::string& name : initialiser_names()) {
    const auto result = make_initialiser(name)->estimate({acs, Eigen::Matrix3d::Identity(), 700.0, 0});
    ASSERT_EQ(result.status, PoseStatus::kOk) << name;
    EXPECT_LT(rotation_error(result.pose.R, truth.R), 1e-4) << name;
    EXPECT_LT(direction_error(result.pose.t, truth.t), 1e-3) << name;
  }
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
  EXPECT_THROW(initialiser->configure(mrpt::containers::yaml::FromText("consensus: {treshold_px: 1}")),
               InputError);
  EXPECT_THROW(initialiser->configure(mrpt::containers::yaml::FromText("consensus: {threshold_px: -1}")),
               InputError);
}

}  // namespace
}  // namespace oneac
