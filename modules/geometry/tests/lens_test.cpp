#include "oneac/geometry/lens.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oneac {
namespace {

PinholeCamera camera_with(const std::array<double, 8>& distortion,
                          LensModel lens = LensModel::plumb_bob) {
  return {640, 480, 400, 400, 320, 240, distortion, lens};
}

TEST(Lens, PutsNothingElsewhereWithoutTerms) {
  const Eigen::Vector2d x(0.3, -0.7);
  EXPECT_EQ(distorted(camera_with({}), x), x);
}

TEST(Lens, FollowsTheRationalModel) {
  // r² = 0.25: (1 - 0.05 + 0.00625 + 0.0015625) / (1 + 0.025 + 0.0125 + 0.00625)
  const PinholeCamera camera = camera_with({-0.2, 0.1, 0.01, 0.02, 0.1, 0.1, 0.2, 0.4});
  const double radial = 0.9578125 / 1.04375;
  const Eigen::Vector2d found = distorted(camera, {0.3, 0.4});
  EXPECT_NEAR(found.x(), 0.3 * radial + 2 * 0.01 * 0.12 + 0.02 * (0.25 + 0.18), 1e-15);
  EXPECT_NEAR(found.y(), 0.4 * radial + 0.01 * (0.25 + 0.32) + 2 * 0.02 * 0.12, 1e-15);
}

TEST(Lens, FollowsTheFisheyesAngle) {
  const PinholeCamera camera = camera_with({0.1, 0, 0, 0}, LensModel::kannala_brandt);
  const double angle = M_PI / 4;  // of the direction (0.6, 0.8, 1)
  const Eigen::Vector2d found = distorted(camera, {0.6, 0.8});
  EXPECT_NEAR(found.norm(), angle * (1 + 0.1 * angle * angle), 1e-15);
  EXPECT_NEAR(found.x() / found.y(), 0.75, 1e-15);
  EXPECT_TRUE(distorted(camera, {0, 0}).isZero());
}

TEST(Lens, UndistortingUndoesIt) {
  for (const PinholeCamera& camera :
       {camera_with({-0.2, 0.1, 0.01, 0.02, 0.05, 0.01, 0.02, 0.04}),
        camera_with({0.05, -0.01, 0.003, -0.001}, LensModel::kannala_brandt),
        camera_with({}, LensModel::kannala_brandt)}) {
    const double widest = camera.lens == LensModel::kannala_brandt ? 6.0 : 0.8;
    for (double r = 0.0; r <= widest; r += widest / 16) {
      const Eigen::Vector2d x(0.6 * r, -0.8 * r);
      const auto back = undistorted(camera, distorted(camera, x));
      ASSERT_TRUE(back.has_value()) << r;
      EXPECT_LT((*back - x).norm(), 1e-7 * (1.0 + r * r)) << r;
    }
  }
}

TEST(Lens, NoDirectionOfAPinholeCameraIsBesideOrBehindIt) {
  const PinholeCamera fisheye = camera_with({}, LensModel::kannala_brandt);
  EXPECT_FALSE(undistorted(fisheye, {1.6, 0.0}).has_value());
  EXPECT_FALSE(undistorted(camera_with({-0.5}), {0.9, 0.0}).has_value()) << "beyond the fold";
  EXPECT_FALSE(undistorted(fisheye, {NAN, 0.0}).has_value());
}

TEST(Lens, HasFiveTermsOnlyWithoutOthers) {
  EXPECT_TRUE(is_five_term_lens(camera_with({-0.2, 0.1, 0.01, 0.02, 0.1})));
  EXPECT_FALSE(is_five_term_lens(camera_with({0, 0, 0, 0, 0, 0, 0, 1e-9})));
  EXPECT_FALSE(is_five_term_lens(camera_with({}, LensModel::kannala_brandt)));
}

}  // namespace
}  // namespace oneac
