#pragma once

#include "point_solver_tools.h"

#include "oneac/solvers/essential_5pc.h"
#include "oneac/solvers/essential_8pc.h"
#include "oneac/solvers/homography_2ac.h"
#include "oneac/solvers/homography_4pc.h"
#include "oneac/solvers/homography_decomposition.h"
#include "oneac/solvers/relpose_1ac_front_wall.h"
#include "oneac/solvers/relpose_1ac_ground.h"
#include "oneac/solvers/relpose_1ac_planar.h"
#include "oneac/solvers/relpose_1ac_planar_pitch.h"
#include "oneac/solvers/relpose_1ac_side_wall.h"
#include "oneac/solvers/relpose_1ac_wall.h"
#include "oneac/solvers/relpose_1pc_ackermann.h"
#include "oneac/solvers/relpose_2pc_ground.h"
#include "oneac/solvers/relpose_2pc_planar.h"
#include "oneac/solvers/relpose_3pc_vertical.h"

#include <string_view>
#include <vector>

namespace oneac::test {

enum class Motion { kPlanar, kCircular, kPitched, kGeneral };
enum class Surface { kGround, kSide, kFront, kWall, kPlane, kAny };

/// What a solver says about correspondences: how many solutions, and the poses among them that
/// have the points before both cameras.
struct Answer {
  std::size_t solutions = 0;
  std::vector<RelativePose> poses;
};

/// A solver of the registry and the scenes that it is made for.
struct EverySolver {
  std::string_view name;
  Motion motion;
  Surface surface;
  int count;
  Answer (*solve)(AcSpan);
};

template <class Set>
Answer answer_of_poses(const Set& found) {
  Answer answer{found.size(), {}};
  for (const auto& solution : found) answer.poses.push_back(solution.pose());
  return answer;
}

template <SolutionSet<Eigen::Matrix3d, 1> (*kSolve)(AcSpan, const double*)>
Answer homography_answer(AcSpan acs) {
  const auto H = kSolve(acs, nullptr);
  if (H.empty()) return {};
  Answer answer = answer_of_poses(poses_from_homography(H[0], acs));
  answer.solutions = 1;
  return answer;
}

template <class Set>
Answer essential_answer(const Set& found, AcSpan acs) {
  Answer answer{found.size(), {}};
  for (const Eigen::Matrix3d& E : found) {
    for (const RelativePose& pose : pose_from_essential(E, acs)) answer.poses.push_back(pose);
  }
  return answer;
}

template <auto kSolve>
Answer of_one(AcSpan acs) {
  return answer_of_poses(kSolve(acs[0]));
}

template <auto kSolve>
Answer of_points(AcSpan acs) {
  return answer_of_poses(kSolve(acs, nullptr));
}

inline const std::vector<EverySolver>& every_solver() {
  static const std::vector<EverySolver> kList = {
      {"relpose_1ac_ground", Motion::kPlanar, Surface::kGround, 1, &of_one<&relpose_1ac_ground>},
      {"relpose_1ac_ground_rapid", Motion::kPlanar, Surface::kGround, 1,
       &of_one<&relpose_1ac_ground_rapid>},
      {"relpose_1ac_side_wall", Motion::kPlanar, Surface::kSide, 1,
       &of_one<&relpose_1ac_side_wall>},
      {"relpose_1ac_side_wall_rapid", Motion::kPlanar, Surface::kSide, 1,
       &of_one<&relpose_1ac_side_wall_rapid>},
      {"relpose_1ac_front_wall", Motion::kPlanar, Surface::kFront, 1,
       &of_one<&relpose_1ac_front_wall>},
      {"relpose_1ac_front_wall_rapid", Motion::kPlanar, Surface::kFront, 1,
       &of_one<&relpose_1ac_front_wall_rapid>},
      {"relpose_1ac_wall", Motion::kPlanar, Surface::kWall, 1, &of_one<&relpose_1ac_wall>},
      {"relpose_1ac_wall_candidates", Motion::kPlanar, Surface::kWall, 1,
       &of_one<&relpose_1ac_wall_candidates>},
      {"relpose_1ac_planar", Motion::kPlanar, Surface::kAny, 1, &of_one<&relpose_1ac_planar>},
      {"relpose_1ac_planar_pitch", Motion::kPitched, Surface::kAny, 1,
       [](AcSpan acs) { return answer_of_poses(relpose_1ac_planar_pitch(acs[0])); }},
      {"relpose_1pc_ackermann", Motion::kCircular, Surface::kAny, 1,
       &of_points<&relpose_1pc_ackermann>},
      {"relpose_2pc_ground", Motion::kPlanar, Surface::kGround, 2, &of_points<&relpose_2pc_ground>},
      {"relpose_2pc_planar", Motion::kPlanar, Surface::kAny, 2,
       [](AcSpan acs) { return answer_of_poses(relpose_2pc_planar(acs)); }},
      {"relpose_3pc_vertical", Motion::kPlanar, Surface::kWall, 3,
       &of_points<&relpose_3pc_vertical>},
      {"homography_2ac", Motion::kGeneral, Surface::kPlane, 2, &homography_answer<&homography_2ac>},
      {"homography_4pc", Motion::kGeneral, Surface::kPlane, 4, &homography_answer<&homography_4pc>},
      {"essential_5pc", Motion::kGeneral, Surface::kAny, 5,
       [](AcSpan acs) { return essential_answer(essential_5pc(acs), acs); }},
      {"essential_8pc", Motion::kGeneral, Surface::kAny, 8,
       [](AcSpan acs) { return essential_answer(essential_8pc(acs), acs); }},
  };
  return kList;
}

inline RelativePose motion_of(const EverySolver& solver, SceneGenerator& scene) {
  if (solver.motion == Motion::kGeneral) return scene.general_motion();
  RelativePose T = scene.planar_motion();
  if (solver.motion == Motion::kCircular) {
    const double half = 0.5 * std::atan2(T.R(2, 0), T.R(0, 0));
    T.t = T.t.norm() * Eigen::Vector3d(std::sin(half), 0.0, -std::cos(half));
  }
  if (solver.motion == Motion::kPitched) {
    const Eigen::Matrix3d Q = pitch_rotation(scene.uniform(-0.05, 0.05));
    T = {Q.transpose() * T.R, Q.transpose() * T.t};
  }
  return T;
}

inline Plane plane_of(const EverySolver& solver, SceneGenerator& scene) {
  switch (solver.surface) {
    case Surface::kGround:
      return scene.ground();
    case Surface::kSide:
      return {Eigen::Vector3d::UnitX(), scene.uniform(2, 6)};
    case Surface::kFront:
      return {Eigen::Vector3d::UnitZ(), scene.uniform(4, 20)};
    case Surface::kWall: {
      const double delta = scene.uniform(0.5, 2.6);
      return {{std::cos(delta), 0.0, std::sin(delta)}, scene.uniform(3, 15)};
    }
    default:
      return scene.any_plane();
  }
}

/// Correspondences that the solver is made for, away from the horizon of both views.
inline std::vector<AffineCorrespondence> correspondences_of(const EverySolver& solver,
                                                            SceneGenerator& scene,
                                                            const RelativePose& T,
                                                            const Plane& plane) {
  std::vector<AffineCorrespondence> acs;
  while (static_cast<int>(acs.size()) < solver.count) {
    const Plane& of_this = solver.surface == Surface::kAny ? scene.any_plane() : plane;
    const AffineCorrespondence ac = scene.on_plane(T, of_this);
    if (!(ac.x1.cwiseAbs().minCoeff() > 0.05) || !(ac.x2.cwiseAbs().minCoeff() > 0.05)) continue;
    acs.push_back(ac);
  }
  return acs;
}

}  // namespace oneac::test
