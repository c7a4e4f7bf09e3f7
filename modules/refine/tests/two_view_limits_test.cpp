#include "refine_scenes.h"

#include "oneac/refine/two_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>

namespace oneac {
namespace {

using test::expect_same_pose;
using test::kFocal;
using test::refine;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(RefineTwoView, RefusesWhatItCannotRefine) {
  SceneGenerator generator(23);
  const auto scene = test::street(generator, 20, {0.2, 0.05});
  const auto expect_refused = [&](const test::TwoViewScene& s, const RelativePose& start,
                                  RefineStatus status) {
    const RefineResult result = refine(s, start);
    EXPECT_EQ(to_string(result.status), std::string(to_string(status)));
    EXPECT_FALSE(result.usable());
    EXPECT_TRUE(result.pose.is_finite());
    if (start.is_finite()) expect_same_pose(result.pose, start);
    EXPECT_TRUE(result.information.isZero(0.0));
    EXPECT_EQ(result.affine_consistent.size(), s.acs.size());
  };
  auto few = scene;
  few.acs.resize(7);
  expect_refused(few, scene.truth, RefineStatus::kTooFew);
  expect_refused({}, scene.truth, RefineStatus::kTooFew);
  expect_refused(scene, {scene.truth.R, Eigen::Vector3d::Zero()}, RefineStatus::kNoTranslation);
  for (const double bad : {kNaN, kInf}) {
    expect_refused(scene, {scene.truth.R, {0.0, bad, 1.0}}, RefineStatus::kNotFinite);
    auto broken = scene;
    broken.acs[3].A(1, 0) = bad;
    expect_refused(broken, scene.truth, RefineStatus::kNotFinite);
    broken = scene;
    broken.acs[3].x2.y() = bad;
    expect_refused(broken, scene.truth, RefineStatus::kNotFinite);
  }
}

TEST(RefineTwoView, PrintsNothingEvenWhenNumbersOverflow) {
  SceneGenerator generator(24);
  auto scene = test::street(generator, 20, {0.2, 0.05});
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  const RefineResult fine = refine(scene, scene.truth);
  scene.acs[0].x1.x() = 1e200;
  const RefineResult overflow = refine(scene, scene.truth);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_TRUE(fine.usable());
  EXPECT_TRUE(overflow.pose.is_finite());
  EXPECT_TRUE(std::isfinite(overflow.initial_cost) && std::isfinite(overflow.final_cost));
  if (!overflow.usable()) expect_same_pose(overflow.pose, scene.truth);
}

std::string complaint(const RefineOptions& options) {
  try {
    options.validate();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(RefineOptions, NamesTheFieldThatIsOutOfBounds) {
  const auto expect_named = [](const char* field, const RefineOptions& options) {
    EXPECT_NE(complaint(options).find(std::string("refine.") + field), std::string::npos) << field;
  };
  EXPECT_EQ(complaint({}), "");
  RefineOptions o;
  o.point_noise_px = 0.0;
  expect_named("point_noise_px", o);
  o = {};
  o.affine_noise = kNaN;
  expect_named("affine_noise", o);
  o = {};
  o.loss_sigmas = kInf;
  expect_named("loss_sigmas", o);
  o = {};
  o.affine_terms_below = -1;
  expect_named("affine_terms_below", o);
  o = {};
  o.affine_gate_sigmas = -1.0;
  expect_named("affine_gate_sigmas", o);
  o = {};
  o.max_iterations = 0;
  expect_named("max_iterations", o);
  o = {};
  o.min_inliers = 4;
  expect_named("min_inliers", o);
}

TEST(RefineOptions, DescribesEachOptionOnce) {
  struct Names {
    std::multiset<std::string>* seen;
    void operator()(const char* key, double&, const char*, const char*, Bound) const {
      seen->insert(key);
    }
    void operator()(const char* key, int&, const char*, const char*, Bound) const {
      seen->insert(key);
    }
  };
  std::multiset<std::string> seen;
  RefineOptions options;
  describe(Names{&seen}, options);
  EXPECT_EQ(seen, (std::multiset<std::string>{"point_noise_px", "affine_noise", "loss_sigmas",
                                              "affine_terms_below", "affine_gate_sigmas",
                                              "max_iterations", "min_inliers", "model_noise_px"}));
}

TEST(RefineTwoView, ThrowsOnMisuse) {
  SceneGenerator generator(25);
  const auto scene = test::street(generator, 20, {});
  const std::vector<bool> inliers(20, true);
  const std::vector<bool> fewer(19, true);
  RefineOptions bad;
  bad.max_iterations = 0;
  EXPECT_THROW((void)refine_two_view(scene.acs, fewer, scene.truth, kFocal, {}),
               std::invalid_argument);
  EXPECT_THROW((void)refine_two_view(scene.acs, inliers, scene.truth, 0.0, {}),
               std::invalid_argument);
  EXPECT_THROW((void)refine_two_view(scene.acs, inliers, scene.truth, kNaN, {}),
               std::invalid_argument);
  EXPECT_THROW((void)refine_two_view(scene.acs, inliers, scene.truth, kFocal, bad),
               std::invalid_argument);
}

}  // namespace
}  // namespace oneac
