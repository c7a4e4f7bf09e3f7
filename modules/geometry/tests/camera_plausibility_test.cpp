#include "oneac/geometry/camera_plausibility.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace oneac {
namespace {

PinholeCamera camera_of(int width, int height, double focal, double cx, double cy) {
  PinholeCamera camera;
  camera.width = width;
  camera.height = height;
  camera.fx = camera.fy = focal;
  camera.cx = cx;
  camera.cy = cy;
  return camera;
}

/// KITTI 03's.
PinholeCamera kitti() {
  return camera_of(1242, 375, 721.5377, 609.5593, 172.854);
}

/// The only fault that is found.
std::string fault_of(const PinholeCamera& camera) {
  const auto faults = camera_faults(camera);
  return faults.size() == 1 ? faults.front() : std::to_string(faults.size()) + " faults";
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(CameraPlausibility, FindsNothingAgainstCamerasOfVehicles) {
  EXPECT_TRUE(camera_faults(kitti()).empty());
  PinholeCamera portrait = kitti();
  std::swap(portrait.width, portrait.height);
  std::swap(portrait.cx, portrait.cy);
  EXPECT_TRUE(camera_faults(portrait).empty());
  PinholeCamera wide = kitti();
  wide.fx = wide.fy = 1242 / 2.0 / 3.0;  // 143°
  EXPECT_TRUE(camera_faults(wide).empty());
}

TEST(CameraPlausibility, NoCameraSquashesItsImageByMoreThanFour) {
  PinholeCamera squashed = kitti();
  squashed.fy = squashed.fx / 10.0;
  EXPECT_TRUE(has(impossible_camera(squashed), "as different as 721.538 and 72.1538 px"))
      << impossible_camera(squashed);
  squashed.fy = squashed.fx / 2.0;  // anamorphic
  EXPECT_EQ(impossible_camera(squashed), "");
}

TEST(CameraPlausibility, NamesTheKOfALargerImage) {
  PinholeCamera halved = kitti();
  halved.width /= 2;
  halved.height /= 2;
  const auto faults = camera_faults(halved);
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_TRUE(has(faults[0], "cx = 609.6 px")) << faults[0];
  EXPECT_TRUE(has(faults[0], "621 px")) << faults[0];
  EXPECT_TRUE(has(faults[1], "cy")) << faults[1];
}

TEST(CameraPlausibility, NamesASwappedPrincipalPoint) {
  PinholeCamera swapped = kitti();
  std::swap(swapped.cx, swapped.cy);
  EXPECT_EQ(camera_faults(swapped).size(), 2U);
}

TEST(CameraPlausibility, NamesAFieldOfViewThatNoCameraHas) {
  PinholeCamera camera = kitti();
  camera.fx = camera.fy = 5.0;
  EXPECT_TRUE(has(fault_of(camera), "179.1°")) << fault_of(camera);
  camera.fx = camera.fy = 7500.0;  // 9.5° of width
  EXPECT_TRUE(has(fault_of(camera), "9.5°")) << fault_of(camera);
}

TEST(CameraPlausibility, JudgesTheFieldOfViewByTheLongerSide) {
  PinholeCamera strip = kitti();
  strip.height = 100;  // 7.9°
  strip.cy = 50.0;
  EXPECT_TRUE(camera_faults(strip).empty());
}

TEST(CameraPlausibility, NamesPixelsThatAreNotSquare) {
  PinholeCamera camera = kitti();
  camera.fy = camera.fx / 1.3;
  EXPECT_TRUE(has(fault_of(camera), "differ")) << fault_of(camera);
  camera.fy = camera.fx * 1.3;
  EXPECT_TRUE(has(fault_of(camera), "differ")) << fault_of(camera);
  camera.fy = camera.fx * 1.2;
  EXPECT_TRUE(camera_faults(camera).empty());
}

TEST(CameraPlausibility, TheMiddleHalfEndsAtAQuarter) {
  PinholeCamera camera = kitti();
  camera.cx = 0.26 * camera.width;
  EXPECT_TRUE(camera_faults(camera).empty());
  camera.cx = 0.24 * camera.width;
  EXPECT_TRUE(has(fault_of(camera), "cx"));
  camera.cx = 0.76 * camera.width;
  EXPECT_TRUE(has(fault_of(camera), "cx"));
}

TEST(CameraPlausibility, WritesHugeNumbersShortly) {
  PinholeCamera camera = camera_of(800, 600, 1e300, 404.0, 309.0);
  const auto faults = camera_faults(camera);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_LT(faults[0].size(), 150U) << faults[0];
}

TEST(CameraPlausibility, NoticesASwappedPrincipalPointWithinTheMiddleHalf) {
  PinholeCamera camera = camera_of(640, 480, 500.0, 239.5, 319.5);
  const auto faults = camera_faults(camera);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_NE(faults[0].find("look swapped"), std::string::npos) << faults[0];
  std::swap(camera.cx, camera.cy);
  EXPECT_TRUE(camera_faults(camera).empty());
}

}  // namespace
}  // namespace oneac
