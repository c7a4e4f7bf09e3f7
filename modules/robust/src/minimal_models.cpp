#include "oneac/robust/minimal_models.h"

#include "oneac/geometry/essential.h"
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

namespace oneac {
namespace {

// Suspension between two frames: up to 2.5° of pitch on a car, plus what the levelling leaves.
constexpr double kMaxPitch = 3.0 * 3.14159265358979323846 / 180.0;

template <class Poses>
EssentialSet essentials(const Poses& poses) {
  EssentialSet set;
  for (const auto& solution : poses) {
    const RelativePose T = solution.pose();
    const double length = T.t.norm();
    if (!(length > 0.0)) continue;
    set.push_back(essential_matrix({T.R, T.t / length}));
  }
  return set;
}

template <class Matrices>
EssentialSet copied(const Matrices& matrices) {
  EssentialSet set;
  for (const Eigen::Matrix3d& E : matrices) set.push_back(E);
  return set;
}

template <class Homographies>
EssentialSet decomposed(const Homographies& homographies, AcSpan sample) {
  EssentialSet set;
  for (const Eigen::Matrix3d& H : homographies) {
    for (const Eigen::Matrix3d& E : essentials(poses_from_homography(H, sample))) set.push_back(E);
  }
  return set;
}

EssentialSet ground_1ac(AcSpan s) {
  return essentials(relpose_1ac_ground(s[0]));
}
EssentialSet side_wall_1ac(AcSpan s) {
  return essentials(relpose_1ac_side_wall(s[0]));
}
EssentialSet front_wall_1ac(AcSpan s) {
  return essentials(relpose_1ac_front_wall(s[0]));
}
EssentialSet wall_1ac(AcSpan s) {
  return essentials(relpose_1ac_wall(s[0]));
}
EssentialSet planar_1ac(AcSpan s) {
  return essentials(relpose_1ac_planar(s[0]));
}
EssentialSet pitch_1ac(AcSpan s) {
  return essentials(relpose_1ac_planar_pitch(s[0], kMaxPitch));
}
EssentialSet ground_2pc(AcSpan s) {
  return essentials(relpose_2pc_ground(s));
}
EssentialSet vertical_3pc(AcSpan s) {
  return essentials(relpose_3pc_vertical(s));
}
EssentialSet planar_2pc(AcSpan s) {
  return essentials(relpose_2pc_planar(s));
}
EssentialSet ackermann_1pc(AcSpan s) {
  return essentials(relpose_1pc_ackermann(s));
}
EssentialSet any_5pc(AcSpan s) {
  return copied(essential_5pc(s));
}
EssentialSet any_8pc(AcSpan s) {
  return copied(essential_8pc(s));
}
EssentialSet plane_4pc(AcSpan s) {
  return decomposed(homography_4pc(s), s);
}
EssentialSet plane_2ac(AcSpan s) {
  return decomposed(homography_2ac(s), s);
}

using M = MinimalMethod;
constexpr std::array<MinimalModel, kMinimalMethods.size()> kModels = {{
    {M::k1acGround, "1ac_ground", 1, true, ground_1ac},
    {M::k1acSideWall, "1ac_side_wall", 1, true, side_wall_1ac},
    {M::k1acFrontWall, "1ac_front_wall", 1, true, front_wall_1ac},
    {M::k1acWall, "1ac_wall", 1, true, wall_1ac},
    {M::k1acPlanar, "1ac_planar", 1, true, planar_1ac},
    {M::k1acPlanarPitch, "1ac_planar_pitch", 1, true, pitch_1ac},
    {M::k2pcGround, "2pc_ground", 2, true, ground_2pc},
    {M::k3pcVertical, "3pc_vertical", 3, true, vertical_3pc},
    {M::k2pcPlanar, "2pc_planar", 2, true, planar_2pc},
    {M::k1pcAckermann, "1pc_ackermann", 1, true, ackermann_1pc},
    {M::k5pc, "5pc", 5, false, any_5pc},
    {M::k8pc, "8pc", 8, false, any_8pc},
    {M::k4pc, "4pc", 4, false, plane_4pc},
    {M::k2ac, "2ac", 2, false, plane_2ac},
}};

}  // namespace

const MinimalModel& minimal_model(MinimalMethod method) {
  return kModels[static_cast<std::size_t>(method)];
}

}  // namespace oneac
