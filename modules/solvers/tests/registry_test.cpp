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
#include <limits>
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

/// Room for poses of some samples, all of it sevens.
struct Room {
  explicit Room(std::size_t samples, std::size_t room)
      : R(9 * samples * room, 7.0),
        t(3 * samples * room, 7.0),
        n(3 * samples * room, 7.0),
        count(samples, 7),
        rows{R.data(), t.data(), n.data(), count.data(), room} {}

  [[nodiscard]] PlanePose at(std::size_t row) const {
    using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    PlanePose pose;
    pose.motion.R = Eigen::Map<const RowMajor>(R.data() + 9 * row);
    pose.motion.t = Eigen::Map<const Eigen::Vector3d>(t.data() + 3 * row);
    pose.n = Eigen::Map<const Eigen::Vector3d>(n.data() + 3 * row);
    return pose;
  }

  std::vector<double> R, t, n;
  std::vector<std::int64_t> count;
  PoseRows rows;
};

void expect_equal(const PlanePose& pose, const PlanePose& other) {
  EXPECT_EQ(pose.motion.R, other.motion.R);
  EXPECT_EQ(pose.motion.t, other.motion.t);
  EXPECT_EQ(pose.n, other.n);
}

constexpr std::size_t kRowSamples = 3;

/// Correspondences of some samples, the second of them of no motion.
std::vector<AffineCorrespondence> samples_in_a_row(const Solver& solver, SceneGenerator& scene) {
  std::vector<AffineCorrespondence> acs;
  for (std::size_t i = 0; i < kRowSamples; ++i) {
    const OwnScene own(solver, scene);
    acs.insert(acs.end(), own.acs.begin(), own.acs.end());
  }
  acs[solver.sample].x2.setConstant(std::numeric_limits<double>::quiet_NaN());
  return acs;
}

TEST(SolverList, RowsOfManySamplesAreTheirSetsAndNoMotionInTheRest) {
  SceneGenerator scene(9);
  const PlanePose none{{}, Eigen::Vector3d::Zero()};
  for (const Solver& solver : solvers()) {
    for (const std::size_t room : {std::size_t{1}, PoseSet::kCapacity}) {
      SCOPED_TRACE(std::string(solver.name) + ", room for " + std::to_string(room));
      const std::vector<AffineCorrespondence> acs = samples_in_a_row(solver, scene);
      Room rows(kRowSamples, room);
      solver.run.rows(acs, solver.sample, rows.rows);
      for (std::size_t i = 0; i < kRowSamples; ++i) {
        const PoseSet set = solver.run.poses({acs.data() + i * solver.sample, solver.sample});
        const std::size_t size = std::min(set.size(), room);
        EXPECT_EQ(rows.count[i], static_cast<std::int64_t>(size));
        for (std::size_t k = 0; k < room; ++k) {
          expect_equal(rows.at(i * room + k), k < size ? set[k] : none);
        }
      }
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
