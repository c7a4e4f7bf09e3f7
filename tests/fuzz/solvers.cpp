// Every solver of the list on any doubles: no NaN, rotations are rotations, sets keep their bounds.
#include "correspondences.h"

#include "oneac/solvers/gravity.h"
#include "oneac/solvers/homography_2ac.h"
#include "oneac/solvers/homography_4pc.h"
#include "oneac/solvers/registry.h"
#include "oneac/solvers/relpose_1ac_ground.h"
#include "oneac/solvers/relpose_1ac_planar.h"
#include "oneac/solvers/relpose_1ac_planar_pitch.h"
#include "oneac/solvers/relpose_1ac_wall.h"
#include "oneac/solvers/relpose_2pc_ground.h"
#include "oneac/solvers/relpose_3pc_vertical.h"

namespace {

using namespace oneac;

template <class Solutions>
void check_poses(std::string_view solver, const Solutions& solutions) {
  try {
    fuzz::check(solutions.size() <= Solutions::kCapacity, "a set keeps its bound");
    for (const auto& solution : solutions) fuzz::check_pose(solution.pose());
  } catch (const std::logic_error& finding) {
    throw std::logic_error(std::string(solver) + ": " + finding.what());
  }
}

template <std::size_t N>
void check_matrices(const SolutionSet<Eigen::Matrix3d, N>& solutions) {
  fuzz::check(solutions.size() <= N, "a set keeps its bound");
  for (const Eigen::Matrix3d& M : solutions) fuzz::check(M.allFinite(), "a matrix is finite");
}

void solve_listed(AcSpan acs) {
  for (const Solver& solver : solvers()) {
    if (solver.run.least_squares != nullptr)
      check_poses(solver.name, solver.run.least_squares(acs));
    if (acs.size() < solver.sample) continue;
    const auto count = static_cast<int>(solver.run.count(acs));
    fuzz::check(count <= solver.run.max_candidates, "a set keeps its bound");
    check_poses(solver.name, solver.run.poses(acs));
    check_matrices(solver.run.essentials(acs));
  }
  check_poses("relpose_1ac_planar_pitch", relpose_1ac_planar_pitch(acs[0]));
}

void solve_homographies(AcSpan acs) {
  for (const auto& set : {homography_2ac(acs), homography_4pc(acs)}) {
    check_matrices(set);
    for (const Eigen::Matrix3d& H : set)
      check_poses("decompose_homography", decompose_homography(H));
  }
}

void solve_with_gravity(AcSpan acs, fuzz::Numbers& numbers) {
  const Eigen::Vector3d down1(numbers.number(), numbers.number(), numbers.number());
  const Eigen::Vector3d down2(numbers.number(), numbers.number(), numbers.number());
  check_poses("relpose_1ac_ground", solve_tilted(acs[0], down1, down2, relpose_1ac_ground));
  check_poses("relpose_1ac_wall", solve_tilted(acs[0], down1, down2, relpose_1ac_wall));
  check_poses("relpose_1ac_planar", solve_tilted(acs[0], down1, down2, relpose_1ac_planar));
  check_poses("relpose_2pc_ground",
              solve_tilted<2>(acs, down1, down2, [](AcSpan s) { return relpose_2pc_ground(s); }));
  check_poses("relpose_3pc_vertical",
              solve_tilted<3>(acs, down1, down2, [](AcSpan s) { return relpose_3pc_vertical(s); }));
}

}  // namespace

ONEAC_FUZZ_TARGET(solvers) {
  constexpr std::size_t kMost = 9;  // one more than the eight-point solver needs
  fuzz::Numbers numbers(data);
  const std::size_t count = 1 + numbers.byte() % kMost;
  const auto acs = fuzz::correspondences(numbers, count);
  solve_listed(acs);
  solve_homographies(acs);
  solve_with_gravity(acs, numbers);
}
