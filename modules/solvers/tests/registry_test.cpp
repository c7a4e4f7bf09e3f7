#include "oneac/solvers/registry.h"

#include "point_solver_tools.h"

#include "oneac/geometry/essential.h"
#include "oneac/test_support/solver_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace oneac {
namespace {

TEST(SolverList, NamesAreUniqueAndDocumented) {
  std::set<std::string_view> names, labels;
  for (const Solver& solver : solvers()) {
    EXPECT_TRUE(names.insert(solver.name).second) << solver.name;
    EXPECT_TRUE(labels.insert(solver.label).second) << solver.label;
    EXPECT_GT(solver.sample, 0U) << solver.name;
    EXPECT_LE(solver.sample, kLargestSample) << solver.name;
    EXPECT_FALSE(solver.unknowns.empty()) << solver.name;
    std::string page(solver.name);  // forms of one solver share its page
    for (const std::string suffix : {"_rapid", "_candidates"}) {
      if (page.size() > suffix.size() && page.substr(page.size() - suffix.size()) == suffix) {
        page.resize(page.size() - suffix.size());
      }
    }
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(ONEAC_SOLVER_PAGES) / (page + ".md")))
        << page;
  }
}

TEST(SolverList, FindsARowByItsName) {
  for (const Solver& solver : solvers()) EXPECT_EQ(&solver_named(solver.name), &solver);
  EXPECT_THROW((void)solver_named("relpose_0ac"), std::invalid_argument);
}

/// A scene of the solver's own kind.
struct OwnScene {
  RelativePose T;
  Plane plane;
  std::vector<AffineCorrespondence> acs;

  OwnScene(const Solver& solver, SceneGenerator& scene)
      : T(test::motion_of(solver, scene)),
        plane(test::plane_of(solver, scene)),
        acs(test::correspondences_of(solver, scene, T, plane)) {}
};

TEST(SolverList, FormsOfARowFindTheSameMotion) {
  SceneGenerator scene(5);
  for (const Solver& solver : solvers()) {
    for (int i = 0; i < 20; ++i) {
      SCOPED_TRACE(std::string(solver.name) + ", scene " + std::to_string(i) + " of seed 5");
      const OwnScene own(solver, scene);
      const AcSpan acs(own.acs);
      EXPECT_LE(static_cast<int>(solver.run.count(acs)), solver.run.max_candidates);
      EXPECT_LT(test::nearest_pose(solver.run.poses(acs), own.T), 1e-4);
      const Eigen::Matrix3d E = essential_matrix({own.T.R, own.T.t.normalized()});
      double nearest = 10.0;
      for (const Eigen::Matrix3d& found : solver.run.essentials(acs)) {
        EXPECT_NEAR(found.norm(), std::sqrt(2.0), 1e-9);
        nearest = std::min({nearest, (found - E).norm(), (found + E).norm()});
      }
      EXPECT_LT(nearest, 1e-4);
    }
  }
}

TEST(SolverList, PosesPutIntoRoomAreThoseOfTheSetAndNoMore) {
  SceneGenerator scene(9);
  for (const Solver& solver : solvers()) {
    SCOPED_TRACE(solver.name);
    const OwnScene own(solver, scene);
    const PoseSet set = solver.run.poses(own.acs);
    std::array<PlanePose, PoseSet::kCapacity> room;
    for (PlanePose& pose : room) pose.n.setConstant(7.0);
    ASSERT_EQ(solver.run.put(own.acs, room.data()), set.size());
    for (std::size_t i = 0; i < room.size(); ++i) {
      if (i >= set.size()) {
        EXPECT_EQ(room[i].n, Eigen::Vector3d::Constant(7.0));
        continue;
      }
      EXPECT_EQ(room[i].motion.R, set[i].motion.R);
      EXPECT_EQ(room[i].motion.t, set[i].motion.t);
      EXPECT_EQ(room[i].n, set[i].n);
    }
  }
}

TEST(SolverList, LeastSquaresOfExactCorrespondencesIsTheirMotion) {
  SceneGenerator scene(6);
  for (const Solver& solver : solvers()) {
    if (solver.run.least_squares == nullptr) continue;
    SCOPED_TRACE(solver.name);
    OwnScene own(solver, scene);
    for (int i = 0; i < 10; ++i) {
      for (const auto& ac : test::correspondences_of(solver, scene, own.T, own.plane)) {
        own.acs.push_back(ac);
      }
    }
    EXPECT_LT(test::nearest_pose(solver.run.least_squares(own.acs), own.T), 1e-4);
  }
}

TEST(SolverList, KnownPlanesGiveTheirNormalAndLengthsInTheirUnit) {
  SceneGenerator scene(7);
  for (const Solver& solver : solvers()) {
    if (solver.unit == "1") continue;
    SCOPED_TRACE(solver.name);
    const OwnScene own(solver, scene);
    double nearest = 10.0;
    for (const PlanePose& pose : solver.run.poses(own.acs)) {
      nearest = std::min(
          nearest, (pose.n - own.plane.n).norm() + (pose.motion.t * own.plane.d - own.T.t).norm());
    }
    EXPECT_LT(nearest, 1e-4);
  }
}

TEST(SolverList, ThePoolIsOfPlanarMotionsFromOneCorrespondence) {
  SceneGenerator scene(8);
  for (const Solver& solver : solvers()) {
    if (solver.pool == PoolUse::kNever) continue;
    SCOPED_TRACE(solver.name);
    ASSERT_NE(solver.run.planar, nullptr);
    EXPECT_EQ("relpose_1ac_" + std::string(solver.pool_key()), solver.name);
    EXPECT_FALSE(solver.method.empty());
    const OwnScene own(solver, scene);
    EXPECT_LT(test::nearest_pose(solver.run.planar(own.acs[0]), own.T), 1e-6);
  }
}

TEST(SolverList, TableOfTheDocumentationIsTheLists) {
  const std::filesystem::path page = std::filesystem::path(ONEAC_SOLVER_PAGES) / "README.md";
  std::ifstream in(page);
  ASSERT_TRUE(in) << page;
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const std::string begin = "<!-- solver table: oneac_solver_table -->\n";
  const std::string end = "<!-- end of solver table -->\n";
  const std::size_t from = text.find(begin);
  const std::size_t to = text.find(end);
  ASSERT_TRUE(from != std::string::npos && to != std::string::npos) << page;
  EXPECT_EQ(text.substr(from + begin.size(), to - from - begin.size()), solver_table());
}

}  // namespace
}  // namespace oneac
