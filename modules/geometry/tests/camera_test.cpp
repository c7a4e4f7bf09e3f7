#include "oneac/geometry/camera.h"

#include "oneac/geometry/camera_frame.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <limits>
#include <stdexcept>
#include <string>

namespace oneac {
namespace {

PinholeCamera wide_camera() {
  return {1024, 768, 790.0, 800.0, 517.0, 395.0, {}};
}
PinholeCamera narrow_camera() {
  return {640, 480, 1500.0, 1200.0, 300.0, 250.0, {}};
}

Eigen::Matrix2d scaling(const PinholeCamera& camera) {
  return Eigen::Vector2d(camera.fx, camera.fy).asDiagonal();
}

std::string complaint_about(const PinholeCamera& camera) {
  try {
    camera.validate();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(PinholeCamera, ProjectsTheOpticalAxisOnThePrincipalPoint) {
  EXPECT_EQ(wide_camera().project({0, 0}), Eigen::Vector2d(517, 395));
  EXPECT_EQ(wide_camera().project({1, -0.25}), Eigen::Vector2d(517 + 790, 395 - 200));
}

TEST(PinholeCamera, NormaliseUndoesProject) {
  SceneGenerator scenes(2);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector2d x = scenes.image_point();
    EXPECT_TRUE(narrow_camera().normalise(narrow_camera().project(x)).isApprox(x, 1e-12));
  }
}

TEST(PinholeCamera, FocalLengthIsTheGeometricMean) {
  EXPECT_DOUBLE_EQ((PinholeCamera{10, 10, 200.0, 800.0, 5, 5, {}}.focal_px()), 400.0);
}

TEST(PinholeCamera, IsDistortedWithAnyCoefficient) {
  EXPECT_FALSE(wide_camera().is_distorted());
  for (std::size_t k = 0; k < wide_camera().distortion.size(); ++k) {
    PinholeCamera camera = wide_camera();
    camera.distortion[k] = -0.01;
    EXPECT_TRUE(camera.is_distorted()) << k;
  }
}

TEST(PinholeCamera, AFisheyeIsDistortedWithoutCoefficients) {
  PinholeCamera camera = wide_camera();
  camera.lens = LensModel::kannala_brandt;
  EXPECT_TRUE(camera.is_distorted());
}

TEST(PinholeCamera, ResizedImagesSeeTheSame) {
  const PinholeCamera half = *resized({1024, 768, 800, 810, 511.5, 383.5, {}}, 512, 384);
  EXPECT_EQ(half.width, 512);
  EXPECT_DOUBLE_EQ(half.fx, 400);
  EXPECT_DOUBLE_EQ(half.fy, 405);
  EXPECT_DOUBLE_EQ(half.cx, 255.5);  // the middle of the picture
  EXPECT_DOUBLE_EQ(half.cy, 191.5);
  EXPECT_TRUE(resized({1242, 375, 721, 721, 600, 180, {}}, 621, 187));  // 187.5
  EXPECT_FALSE(resized({1242, 375, 721, 721, 600, 180, {}}, 621, 186));
  EXPECT_FALSE(resized({1024, 768, 800, 810, 511.5, 383.5, {}}, 1024, 576));
  EXPECT_FALSE(resized({0, 0, 800, 810, 511.5, 383.5, {}}, 1024, 576));
}

TEST(PinholeCamera, ValidationNamesFieldValueAndBound) {
  EXPECT_NO_THROW(wide_camera().validate());
  PinholeCamera camera = wide_camera();
  camera.fy = -2.0;
  const std::string complaint = complaint_about(camera);
  EXPECT_EQ(complaint, "PinholeCamera.fy = -2, must be positive and finite");
}

TEST(PinholeCamera, ValidationLooksAtEveryField) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const auto expect = [](const PinholeCamera& camera, const std::string& field) {
    EXPECT_NE(complaint_about(camera).find("." + field + " ="), std::string::npos) << field;
  };
  expect({0, 768, 1, 1, 0, 0, {}}, "width");
  expect({1024, -1, 1, 1, 0, 0, {}}, "height");
  expect({1024, 768, 0, 1, 0, 0, {}}, "fx");
  expect({1024, 768, inf, 1, 0, 0, {}}, "fx");
  expect({1024, 768, 1, nan, 0, 0, {}}, "fy");
  expect({1024, 768, 1, 1, nan, 0, {}}, "cx");
  expect({1024, 768, 1, 1, 0, inf, {}}, "cy");
  expect({1024, 768, 1, 1, 0, 0, {0, 0, 0, 0, nan}}, "distortion");
}

TEST(NormaliseCorrespondence, TakesEachPointWithItsOwnCamera) {
  const AffineCorrespondence ac =
      normalise({{517, 395}, {300 + 150, 250 + 240}, Eigen::Matrix2d::Identity()}, wide_camera(),
                narrow_camera());
  EXPECT_TRUE(ac.x1.isZero());
  EXPECT_TRUE(ac.x2.isApprox(Eigen::Vector2d(0.1, 0.2)));
}

TEST(NormaliseCorrespondence, TakesTheAffinityToK2InverseTimesAxK1) {
  Eigen::Matrix2d A_px;
  A_px << 1.1, -0.2, 0.3, 0.9;
  const Eigen::Matrix2d expected =
      scaling(narrow_camera()).inverse() * A_px * scaling(wide_camera());
  const auto ac = normalise({{10, 20}, {30, 40}, A_px}, wide_camera(), narrow_camera());
  EXPECT_TRUE(ac.A.isApprox(expected, 1e-14));
}

TEST(NormaliseCorrespondence, KeepsTheAffinityTheDerivativeOfThePoints) {
  // A small pixel step du1 becomes A_px du1; so it must in normalised coordinates.
  Eigen::Matrix2d A_px;
  A_px << 1.1, -0.2, 0.3, 0.9;
  const Eigen::Vector2d u1(100, 200), u2(150, 120), du1(0.4, -0.7);
  const auto ac = normalise({u1, u2, A_px}, wide_camera(), narrow_camera());
  const Eigen::Vector2d dx1 = wide_camera().normalise(u1 + du1) - ac.x1;
  const Eigen::Vector2d dx2 = narrow_camera().normalise(u2 + A_px * du1) - ac.x2;
  EXPECT_TRUE((ac.A * dx1).isApprox(dx2, 1e-9));
}

TEST(CameraFrame, ForwardLookingMountMapsOpticalAxesToVehicleAxes) {
  const Eigen::Isometry3d T = CameraFrame::forward_looking_mount();
  const Eigen::Vector3d forward(1, 0, 0), left(0, 1, 0), up(0, 0, 1);
  EXPECT_TRUE((T.linear() * Eigen::Vector3d::UnitZ()).isApprox(forward));
  EXPECT_TRUE((T.linear() * Eigen::Vector3d::UnitX()).isApprox(-left));
  EXPECT_TRUE((T.linear() * Eigen::Vector3d::UnitY()).isApprox(-up));
  EXPECT_TRUE(T.translation().isZero());
  EXPECT_DOUBLE_EQ(T.linear().determinant(), 1.0);
}

}  // namespace
}  // namespace oneac
