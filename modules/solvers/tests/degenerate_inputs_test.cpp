// Every solver of the list against every degenerate input: what it returns is the table of
// docs/solvers/README.md.

#include "point_solver_tools.h"

#include "oneac/test_support/solver_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>

namespace oneac {
namespace {

using namespace test;

using Correspondences = std::vector<AffineCorrespondence>;
constexpr int kScenes = 100;
constexpr double kInf = std::numeric_limits<double>::infinity();

/// Good correspondences of a scene and how they came about.
struct Scene {
  RelativePose T;
  Plane plane;
  Correspondences acs;
};

struct Degeneracy {
  const char* name;
  std::vector<Correspondences> (*inputs)(const Solver&, SceneGenerator&, const Scene&);
};

/// `value` in each entry of the first correspondence in turn; points only have four.
std::vector<Correspondences> with_entry(const Solver& solver, const Scene& scene, double value) {
  std::vector<Correspondences> list;
  for (int i = 0; i < (solver.affine ? 8 : 4); ++i) {
    Correspondences acs = scene.acs;
    if (i < 2) acs[0].x1(i) = value;
    if (i >= 2 && i < 4) acs[0].x2(i - 2) = value;
    if (i >= 4) acs[0].A((i - 4) / 2, i % 2) = value;
    list.push_back(acs);
  }
  return list;
}

std::vector<Correspondences> nan_entries(const Solver& s, SceneGenerator&, const Scene& c) {
  return with_entry(s, c, std::nan(""));
}

std::vector<Correspondences> infinite_entries(const Solver& s, SceneGenerator&, const Scene& c) {
  auto list = with_entry(s, c, kInf);
  for (auto& acs : with_entry(s, c, -kInf)) list.push_back(acs);
  return list;
}

std::vector<Correspondences> zeros(const Solver&, SceneGenerator&, const Scene& c) {
  const AffineCorrespondence zero{{0, 0}, {0, 0}, Eigen::Matrix2d::Zero()};
  return {Correspondences(c.acs.size(), zero)};
}

/// All points on the horizon, and at a distance from it that is rounding.
std::vector<Correspondences> horizon(const Solver& solver, SceneGenerator& scene, const Scene& c) {
  std::vector<Correspondences> list;
  for (const double y : {0.0, 1e-14}) {
    Correspondences acs;
    while (acs.size() < c.acs.size()) {
      const Plane plane = on_any_surface(solver) ? scene.any_plane() : c.plane;
      const auto H = plane_induced_homography(c.T, plane);
      const auto ac = correspondence_from_homography(H, {scene.image_point().x(), y});
      if (ac) acs.push_back(*ac);
    }
    list.push_back(acs);
  }
  return list;
}

/// A turn of the kind that the solver's motion allows.
std::vector<Correspondences> pure_rotation_of(const Solver& solver, SceneGenerator&,
                                              const Scene& c) {
  const Eigen::Matrix3d R =
      solver.motion == SolverMotion::kCircular ? yaw_rotation(std::cos(0.2), std::sin(0.2)) : c.T.R;
  Correspondences acs;
  for (const AffineCorrespondence& ac : c.acs) {
    if (const auto seen = correspondence_from_homography(R, ac.x1)) acs.push_back(*seen);
  }
  return {acs};
}

std::vector<Correspondences> no_motion(const Solver&, SceneGenerator&, const Scene& c) {
  Correspondences acs = c.acs;
  for (AffineCorrespondence& ac : acs) ac = {ac.x1, ac.x1, Eigen::Matrix2d::Identity()};
  return {acs};
}

std::vector<Correspondences> coincident(const Solver&, SceneGenerator&, const Scene& c) {
  return {Correspondences(c.acs.size(), c.acs[0])};
}

/// All correspondences on one and the same plane.
std::vector<Correspondences> coincident_planes(const Solver& solver, SceneGenerator& scene,
                                               const Scene& c) {
  Solver on_plane = solver;
  if (on_any_surface(solver)) on_plane.surface = SolverSurface::kPlane;
  return {correspondences_of(on_plane, scene, c.T, scene.any_plane())};
}

/// The second view mirrored.
std::vector<Correspondences> reflection(const Solver&, SceneGenerator&, const Scene& c) {
  Correspondences acs = c.acs;
  for (AffineCorrespondence& ac : acs) {
    ac.x2.x() = -ac.x2.x();
    ac.A.row(0) = -ac.A.row(0);
  }
  return {acs};
}

const std::vector<Degeneracy>& degeneracies() {
  static const std::vector<Degeneracy> kList = {
      {"NaN", &nan_entries},       {"±Inf", &infinite_entries},          {"all zero", &zeros},
      {"horizon", &horizon},       {"pure rotation", &pure_rotation_of}, {"no motion", &no_motion},
      {"coincident", &coincident}, {"one plane", &coincident_planes},    {"mirrored", &reflection},
  };
  return kList;
}

/// What makes the horizon special is a motion along it, or a sample that a line cannot hold.
bool sees_the_horizon_as_any_line(const Solver& solver) {
  const bool two_points = solver.sample == 2 && on_any_surface(solver);
  return solver.motion == SolverMotion::kUpright ||
         (solver.motion == SolverMotion::kAny && two_points);
}

/// "empty" when it never returns anything, "–" when the case is not degenerate for the solver.
std::string behaviour(const Solver& solver, const Degeneracy& degeneracy) {
  if (solver.sample == 1 && degeneracy.inputs == &coincident) return "–";
  if (!on_any_surface(solver) && degeneracy.inputs == &coincident_planes) return "–";
  if (solver.sample == 1 && degeneracy.inputs == &coincident_planes) return "–";
  if (sees_the_horizon_as_any_line(solver) && degeneracy.inputs == &horizon) return "–";
  SceneGenerator scene(77);
  int answered = 0, asked = 0;
  for (int i = 0; i < kScenes; ++i) {
    Scene c{motion_of(solver, scene), plane_of(solver, scene), {}};
    c.acs = correspondences_of(solver, scene, c.T, c.plane);
    for (const Correspondences& acs : degeneracy.inputs(solver, scene, c)) {
      if (acs.size() != c.acs.size()) continue;  // turned out of sight
      for (const PlanePose& pose : solver.run.poses(AcSpan(acs))) {
        EXPECT_TRUE(pose.motion.is_finite())
            << solver.name << ", " << degeneracy.name << ", scene " << i;
      }
      ++asked;
      answered += solver.run.count(AcSpan(acs)) > 0 ? 1 : 0;
    }
  }
  EXPECT_GE(asked, kScenes / 2) << solver.name << ", " << degeneracy.name;
  return answered == 0 ? "empty" : "answers";
}

std::string table() {
  std::string text = "| solver |", rule = "|---|";
  for (const Degeneracy& degeneracy : degeneracies()) {
    text += " " + std::string(degeneracy.name) + " |";
    rule += "---|";
  }
  text += "\n" + rule + "\n";
  for (const Solver& solver : solvers()) {
    text += "| `" + std::string(solver.name) + "` |";
    for (const Degeneracy& degeneracy : degeneracies()) {
      text += " " + behaviour(solver, degeneracy) + " |";
    }
    text += "\n";
  }
  return text;
}

TEST(DegenerateInputs, TableOfTheDocumentationIsWhatTheSolversDo) {
  std::ifstream in(std::filesystem::path(ONEAC_SOLVER_PAGES) / "README.md");
  ASSERT_TRUE(in);
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const std::string begin = "<!-- degenerate inputs: degenerate_inputs_test -->\n";
  const std::string end = "<!-- end of degenerate inputs -->\n";
  const std::size_t from = text.find(begin);
  const std::size_t to = text.find(end);
  ASSERT_TRUE(from != std::string::npos && to != std::string::npos);
  EXPECT_EQ(text.substr(from + begin.size(), to - from - begin.size()), table());
}

TEST(DegenerateInputs, WhatASolverCanSeeGivesNothing) {
  for (const Solver& solver : solvers()) {
    for (const Degeneracy& degeneracy : degeneracies()) {
      const std::string name = degeneracy.name;
      const std::string found = behaviour(solver, degeneracy);
      // Points of one plane have a motion that two solvers find.
      if (name != "one plane") {
        EXPECT_NE(found, "answers") << solver.name << ", " << name;
      }
    }
  }
}

TEST(DegenerateInputs, PointSolversTakePointsWithoutAnAffinity) {
  for (const Solver& solver : solvers()) {
    if (solver.affine) continue;
    SceneGenerator scene(78);
    for (int i = 0; i < kScenes; ++i) {
      const RelativePose T = motion_of(solver, scene);
      Correspondences acs = correspondences_of(solver, scene, T, plane_of(solver, scene));
      const std::size_t full = solver.run.count(AcSpan(acs));
      for (AffineCorrespondence& ac : acs) ac = {ac.x1, ac.x2};
      EXPECT_EQ(solver.run.count(AcSpan(acs)), full) << solver.name << ", scene " << i;
      for (AffineCorrespondence& ac : acs) ac.A.setZero();
      EXPECT_EQ(solver.run.count(AcSpan(acs)), full) << solver.name << ", scene " << i;
    }
  }
}

/// What images never hold and files may: zeros, ones, up to 10^±reach, points that coincide.
class AnyNumbers {
 public:
  explicit AnyNumbers(std::uint64_t seed) : random_(seed) {}

  Correspondences correspondences(std::size_t count, int reach) {
    Correspondences acs(count);
    for (AffineCorrespondence& ac : acs) {
      ac.x1 << number(reach), number(reach);
      ac.x2 << number(reach), number(reach);
      ac.A << number(reach), number(reach), number(reach), number(reach);
      if (ac.A.determinant() < 0.0) ac.A.row(0).swap(ac.A.row(1));
    }
    if (random_() % 4 == 0) acs.back().x1 = acs.front().x1;
    for (AffineCorrespondence& ac : acs) {
      if (random_() % 4 == 0) ac.x2 = ac.x1;
    }
    return acs;
  }

 private:
  double number(int reach) {
    const auto kind = random_() % 16;
    if (kind < 2) return static_cast<double>(kind);
    const double small = std::uniform_real_distribution<>(-2.0, 2.0)(random_);
    return kind < 9
               ? small
               : small * std::pow(10.0, std::uniform_int_distribution<>(-reach, reach)(random_));
  }

  std::mt19937_64 random_;
};

TEST(DegenerateInputs, AnyNumbersGiveRotationsOrNothing) {
  constexpr int kTrials = 60000;
  constexpr int kReaches[] = {0, 2, 12, 160};
  constexpr double kRotation = 1e-7;  // what the decomposition of a homography says of its own
  for (const Solver& solver : solvers()) {
    AnyNumbers numbers(79);
    double worst = 0.0;
    for (int trial = 0; trial < kTrials; ++trial) {
      const auto acs = numbers.correspondences(solver.sample, kReaches[trial % 4]);
      for (const PlanePose& pose : solver.run.poses(AcSpan(acs))) {
        const Eigen::Matrix3d& R = pose.motion.R;
        ASSERT_TRUE(pose.motion.is_finite()) << solver.name << ", trial " << trial;
        worst = std::max(worst, (R.transpose() * R - Eigen::Matrix3d::Identity()).norm());
      }
    }
    EXPECT_LT(worst, kRotation) << solver.name;
  }
}

}  // namespace
}  // namespace oneac
