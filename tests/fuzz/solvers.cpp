// Every solver on any doubles: no NaN, rotations are rotations, sets keep their bounds.
#include "correspondences.h"

#include "oneac/geometry/essential.h"
#include "oneac/solvers/essential_5pc.h"
#include "oneac/solvers/essential_8pc.h"
#include "oneac/solvers/gravity.h"
#include "oneac/solvers/homography_2ac.h"
#include "oneac/solvers/homography_4pc.h"
#include "oneac/solvers/homography_decomposition.h"

namespace {

using namespace oneac;

template <class Solutions>
void check_poses(const char* solver, const Solutions& solutions) {
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

void solve_one(const AffineCorrespondence& ac) {
  check_poses("relpose_1ac_ground", relpose_1ac_ground(ac));
  check_poses("relpose_1ac_ground_rapid", relpose_1ac_ground_rapid(ac));
  check_poses("relpose_1ac_side_wall", relpose_1ac_side_wall(ac));
  check_poses("relpose_1ac_side_wall_rapid", relpose_1ac_side_wall_rapid(ac));
  check_poses("relpose_1ac_front_wall", relpose_1ac_front_wall(ac));
  check_poses("relpose_1ac_front_wall_rapid", relpose_1ac_front_wall_rapid(ac));
  check_poses("relpose_1ac_wall", relpose_1ac_wall(ac));
  check_poses("relpose_1ac_wall_candidates", relpose_1ac_wall_candidates(ac));
  check_poses("relpose_1ac_planar", relpose_1ac_planar(ac));
  check_poses("relpose_1ac_planar_pitch", relpose_1ac_planar_pitch(ac));
}

void solve_many(AcSpan acs) {
  check_poses("relpose_nac_ground", relpose_nac_ground(acs));
  check_poses("relpose_nac_ground_rapid", relpose_nac_ground_rapid(acs));
  check_poses("relpose_nac_side_wall", relpose_nac_side_wall(acs));
  check_poses("relpose_nac_front_wall", relpose_nac_front_wall(acs));
  check_poses("relpose_nac_wall", relpose_nac_wall(acs));
  check_poses("relpose_nac_planar_pitch", relpose_nac_planar_pitch(acs));
  check_poses("relpose_1pc_ackermann", relpose_1pc_ackermann(acs));
  check_poses("relpose_2pc_ground", relpose_2pc_ground(acs));
  check_poses("relpose_2pc_planar", relpose_2pc_planar(acs));
  check_poses("relpose_3pc_vertical", relpose_3pc_vertical(acs));
}

void solve_general(AcSpan acs) {
  for (const auto& set : {homography_2ac(acs), homography_4pc(acs)}) {
    check_matrices(set);
    for (const Eigen::Matrix3d& H : set) {
      check_poses("decompose_homography", decompose_homography(H));
      check_poses("poses_from_homography", poses_from_homography(H, acs));
    }
  }
  const auto five = essential_5pc(acs);
  check_matrices(five);
  for (const Eigen::Matrix3d& E : five) {
    for (const RelativePose& pose : pose_from_essential(E, acs)) fuzz::check_pose(pose);
  }
  check_matrices(essential_8pc(acs));
}

void solve_tilted(AcSpan acs, fuzz::Numbers& numbers) {
  const Eigen::Vector3d down1(numbers.number(), numbers.number(), numbers.number());
  const Eigen::Vector3d down2(numbers.number(), numbers.number(), numbers.number());
  check_poses("relpose_1ac_ground", relpose_1ac_ground(acs[0], down1, down2));
  check_poses("relpose_1ac_wall", relpose_1ac_wall(acs[0], down1, down2));
  check_poses("relpose_1ac_planar", relpose_1ac_planar(acs[0], down1, down2));
  check_poses("relpose_2pc_ground", relpose_2pc_ground(acs, down1, down2));
  check_poses("relpose_3pc_vertical", relpose_3pc_vertical(acs, down1, down2));
}

}  // namespace

ONEAC_FUZZ_TARGET(solvers) {
  constexpr std::size_t kMost = 9;  // one more than the eight-point solver needs
  fuzz::Numbers numbers(data);
  const std::size_t count = 1 + numbers.byte() % kMost;
  const auto acs = fuzz::correspondences(numbers, count);
  solve_one(acs.front());
  solve_many(acs);
  solve_general(acs);
  solve_tilted(acs, numbers);
}
