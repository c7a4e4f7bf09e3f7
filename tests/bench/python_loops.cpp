// What tests/bench/python_solvers.py compares the Python package with: a loop over a solver's own
// function that keeps what it returns, in a library that Python loads.

#include "solver_forms.h"

#include "oneac/solvers/essential_5pc.h"
#include "oneac/solvers/homography_2ac.h"
#include "oneac/solvers/homography_4pc.h"
#include "oneac/solvers/relpose_1ac_front_wall.h"
#include "oneac/solvers/relpose_1ac_ground.h"
#include "oneac/solvers/relpose_1ac_planar.h"
#include "oneac/solvers/relpose_1ac_planar_focal.h"
#include "oneac/solvers/relpose_1ac_side_wall.h"
#include "oneac/solvers/relpose_1ac_wall.h"
#include "oneac/solvers/relpose_1pc_ackermann.h"
#include "oneac/solvers/relpose_2ac.h"
#include "oneac/solvers/relpose_2pc_ground.h"
#include "oneac/solvers/relpose_2pc_planar.h"
#include "oneac/solvers/relpose_3pc_vertical.h"

#include <cstddef>
#include <string_view>
#include <vector>

namespace {

using namespace oneac;
using internal::functions;
using internal::Gives;

std::vector<AffineCorrespondence> g_acs;
std::size_t g_sample = 1;

AcSpan sample(std::size_t i) {
  return {g_acs.data() + i * g_sample, g_sample};
}

std::size_t samples() {
  return g_acs.size() / g_sample;
}

/// Solution sets as the solver returns them.
template <auto kSolve>
std::size_t sets() {
  std::vector<decltype(internal::call<kSolve>(AcSpan()))> kept;
  kept.reserve(samples());
  for (std::size_t i = 0; i < samples(); ++i) kept.push_back(internal::call<kSolve>(sample(i)));
  std::size_t count = 0;
  for (const auto& set : kept) count += set.size();
  return count;
}

/// Poses of a solver whose solutions are matrices.
template <auto kSolve, Gives kGives>
std::size_t poses() {
  std::vector<PlanePose> kept;
  kept.reserve(samples());
  for (std::size_t i = 0; i < samples(); ++i) {
    internal::for_each_pose<kSolve, kGives>(sample(i),
                                            [&](const PlanePose& pose) { kept.push_back(pose); });
  }
  return kept.size();
}

SolutionSet<PitchedPose, 6> planar_pitch(const AffineCorrespondence& ac) {
  return relpose_1ac_planar_pitch(ac, 3.0 * 3.14159265358979323846 / 180.0);
}
SolutionSet<PlanarFocalPose, 1> planar_focal(const AffineCorrespondence& ac) {
  return relpose_1ac_planar_focal(ac, 2.0);
}

struct Row {
  std::string_view name;
  std::size_t (*loop)();
};

constexpr Row kRows[] = {
    {"relpose_1ac_ground", &sets<&relpose_1ac_ground>},
    {"relpose_1ac_ground_rapid", &sets<&relpose_1ac_ground_rapid>},
    {"relpose_1ac_side_wall", &sets<&relpose_1ac_side_wall>},
    {"relpose_1ac_side_wall_rapid", &sets<&relpose_1ac_side_wall_rapid>},
    {"relpose_1ac_front_wall", &sets<&relpose_1ac_front_wall>},
    {"relpose_1ac_front_wall_rapid", &sets<&relpose_1ac_front_wall_rapid>},
    {"relpose_1ac_wall", &sets<&relpose_1ac_wall>},
    {"relpose_1ac_wall_candidates", &sets<&relpose_1ac_wall_candidates>},
    {"relpose_1ac_planar", &sets<&relpose_1ac_planar>},
    {"relpose_1ac_planar_pitch", &sets<&planar_pitch>},
    {"relpose_1ac_planar_focal", &sets<&planar_focal>},
    {"relpose_1ac_vertical", &sets<&relpose_1ac_vertical>},
    {"relpose_1pc_ackermann", &sets<&relpose_1pc_ackermann>},
    {"relpose_2pc_ground", &sets<&relpose_2pc_ground>},
    {"relpose_2pc_planar", &sets<&relpose_2pc_planar>},
    {"relpose_3pc_vertical", &sets<&relpose_3pc_vertical>},
    {"relpose_2ac", &sets<&relpose_2ac>},
    {"homography_2ac", &poses<&homography_2ac, Gives::kHomographies>},
    {"homography_4pc", &poses<&homography_4pc, Gives::kHomographies>},
    {"essential_5pc", &poses<&essential_5pc, Gives::kEssentials>},
    {"essential_8pc", &poses<&essential_8pc, Gives::kEssentials>},
};

}  // namespace

extern "C" {

/// Keeps a copy of `count` samples; A may be null.
void oneac_loops_take(const double* x1, const double* x2, const double* A, std::size_t sample,
                      std::size_t count) {
  g_sample = sample;
  g_acs.resize(sample * count);
  for (std::size_t i = 0; i < g_acs.size(); ++i) {
    g_acs[i].x1 << x1[2 * i], x1[2 * i + 1];
    g_acs[i].x2 << x2[2 * i], x2[2 * i + 1];
    if (A != nullptr) g_acs[i].A << A[4 * i], A[4 * i + 1], A[4 * i + 2], A[4 * i + 3];
  }
}

/// Solves all that were taken: how many solutions, or −1 when no solver has this name.
long oneac_loops_run(const char* name) {
  for (const Row& row : kRows) {
    if (row.name == name) return static_cast<long>(row.loop());
  }
  return -1;
}
}
