// Every solver of the list under the symmetries of the problem.

#include "point_solver_tools.h"

#include "oneac/geometry/camera.h"
#include "oneac/test_support/solver_scenes.h"

#include <gtest/gtest.h>

#include <string>

namespace oneac {
namespace {

using namespace test;

constexpr int kScenes = 300;
// Digits that a double root of a minimal point solver may cost, see the recovery tests: one of the
// 300 scenes is allowed to be worse than kExact.
constexpr int kMisses = 1;

class Symmetry : public testing::TestWithParam<Solver> {
 protected:
  struct Scene {
    RelativePose T;
    Plane plane;
    std::vector<AffineCorrespondence> acs;
  };

  [[nodiscard]] static Scene draw(SceneGenerator& scene, bool turns = true) {
    Scene c{motion_of(GetParam(), scene), plane_of(GetParam(), scene), {}};
    if (!turns) c.T.R.setIdentity();
    c.acs = correspondences_of(GetParam(), scene, c.T, c.plane);
    return c;
  }
  [[nodiscard]] static double error(const std::vector<AffineCorrespondence>& acs,
                                    const RelativePose& truth) {
    double least = 10.0;
    for (const PlanePose& pose : GetParam().run.poses(AcSpan(acs))) {
      least = std::min(least, pose_error(pose.motion, truth));
    }
    return least;
  }
};

TEST_P(Symmetry, SwappedViewsGiveTheInverseMotion) {
  // Known walls must be parallel to an axis of the second camera, too; a car on a circle that
  // drives backwards is a car on a circle; the planar pitch belongs to the second view.
  const bool known_wall = GetParam().surface == SolverSurface::kSideWall ||
                          GetParam().surface == SolverSurface::kFrontWall;
  if (GetParam().motion == SolverMotion::kPitched) {
    SUCCEED() << "the model is not symmetric: only the second view pitches";
    return;
  }
  SceneGenerator scene(1);
  int missed = 0;
  for (int i = 0; i < kScenes; ++i) {
    Scene c = draw(scene, !known_wall);
    for (AffineCorrespondence& ac : c.acs) ac = swapped(ac);
    missed += error(c.acs, c.T.inverse()) < kExact ? 0 : 1;
  }
  EXPECT_LE(missed, kMisses);
}

TEST_P(Symmetry, MirroredScenesGiveMirroredMotions) {
  SceneGenerator scene(2);
  const Eigen::Matrix3d M = Eigen::Vector3d(-1.0, 1.0, 1.0).asDiagonal();
  const Eigen::Matrix2d m = M.topLeftCorner<2, 2>();
  int missed = 0;
  for (int i = 0; i < kScenes; ++i) {
    Scene c = draw(scene);
    for (AffineCorrespondence& ac : c.acs) ac = {m * ac.x1, m * ac.x2, m * ac.A * m};
    missed += error(c.acs, {M * c.T.R * M, M * c.T.t}) < kExact ? 0 : 1;
  }
  EXPECT_LE(missed, kMisses);
}

TEST_P(Symmetry, ScaleOfTheSceneDoesNotMatter) {
  SceneGenerator scene(3);
  for (int i = 0; i < kScenes; ++i) {
    const Scene c = draw(scene);
    if (on_any_surface(GetParam())) continue;  // each point on a plane of its own
    const auto H =
        plane_induced_homography({c.T.R, 1000.0 * c.T.t}, {c.plane.n, 1000.0 * c.plane.d});
    std::vector<AffineCorrespondence> large;
    for (const auto& ac : c.acs) large.push_back(*correspondence_from_homography(H, ac.x1));
    const PoseSet a = GetParam().run.poses(AcSpan(c.acs));
    const PoseSet b = GetParam().run.poses(AcSpan(large));
    ASSERT_EQ(a.size(), b.size()) << "scene " << i << " of seed 3";
    for (std::size_t k = 0; k < a.size(); ++k) {
      EXPECT_LT((a[k].motion.t - b[k].motion.t).norm(), 1e-7) << "scene " << i << " of seed 3";
    }
  }
}

TEST_P(Symmetry, IntrinsicsOfTheCamerasDoNotMatter) {
  const PinholeCamera first{1242, 375, 721.5, 718.2, 609.6, 172.9, {}};
  const PinholeCamera second{800, 600, 410.0, 433.0, 395.0, 310.0, {}};
  const Eigen::Vector2d f1(first.fx, first.fy), f2(second.fx, second.fy);
  SceneGenerator scene(4);
  int missed = 0;
  for (int i = 0; i < kScenes; ++i) {
    Scene c = draw(scene);
    for (AffineCorrespondence& ac : c.acs) {
      AffineCorrespondence px{first.project(ac.x1), second.project(ac.x2), ac.A};
      px.A = f2.asDiagonal() * ac.A * f1.cwiseInverse().asDiagonal();
      ac = normalise(px, first, second);
    }
    missed += error(c.acs, c.T) < kExact ? 0 : 1;
  }
  EXPECT_LE(missed, kMisses);
}

INSTANTIATE_TEST_SUITE_P(Solvers, Symmetry, testing::ValuesIn(solvers()),
                         [](const auto& form) { return std::string(form.param.name); });

}  // namespace
}  // namespace oneac
