#include "oneac/solvers/registry.h"

#include "solver_forms.h"

#include "oneac/solvers/essential_5pc.h"
#include "oneac/solvers/essential_8pc.h"
#include "oneac/solvers/homography_2ac.h"
#include "oneac/solvers/homography_4pc.h"
#include "oneac/solvers/relpose_1ac_front_wall.h"
#include "oneac/solvers/relpose_1ac_ground.h"
#include "oneac/solvers/relpose_1ac_planar.h"
#include "oneac/solvers/relpose_1ac_planar_focal.h"
#include "oneac/solvers/relpose_1ac_planar_pitch.h"
#include "oneac/solvers/relpose_1ac_side_wall.h"
#include "oneac/solvers/relpose_1ac_vertical.h"
#include "oneac/solvers/relpose_1ac_wall.h"
#include "oneac/solvers/relpose_1pc_ackermann.h"
#include "oneac/solvers/relpose_2ac.h"
#include "oneac/solvers/relpose_2pc_ground.h"
#include "oneac/solvers/relpose_2pc_planar.h"
#include "oneac/solvers/relpose_3pc_vertical.h"

#include <algorithm>
#include <stdexcept>

namespace oneac {
namespace {

using internal::functions;
using internal::Gives;

// Suspension between two frames: up to 2.5° of pitch on a car, plus what the levelling leaves.
constexpr double kMaxPitch = 3.0 * 3.14159265358979323846 / 180.0;

SolutionSet<PitchedPose, 6> planar_pitch(const AffineCorrespondence& ac) {
  return relpose_1ac_planar_pitch(ac, kMaxPitch);
}
SolutionSet<PitchedPose, 1> nac_planar_pitch(AcSpan acs) {
  return relpose_nac_planar_pitch(acs, nullptr, kMaxPitch);
}

// Robust loops assume some focal length: one off by more than a factor of two is no guess.
constexpr double kMaxFocalRatio = 2.0;

SolutionSet<PlanarFocalPose, 1> planar_focal(const AffineCorrespondence& ac) {
  return relpose_1ac_planar_focal(ac, kMaxFocalRatio);
}
SolutionSet<PlanarFocalPose, 1> nac_planar_focal(AcSpan acs) {
  return relpose_nac_planar_focal(acs, nullptr, kMaxFocalRatio);
}

std::string_view text(SolverMotion motion) {
  switch (motion) {
    case SolverMotion::kPlanar:
      return "planar motion";
    case SolverMotion::kPitched:
      return "planar motion and a pitch";
    case SolverMotion::kCircular:
      return "circular planar motion";
    case SolverMotion::kUpright:
      return "known vertical";
    default:
      return "any motion";
  }
}

std::string_view text(SolverSurface surface) {
  switch (surface) {
    case SolverSurface::kGround:
      return "ground";
    case SolverSurface::kSideWall:
      return "wall along the road";
    case SolverSurface::kFrontWall:
      return "wall across the road";
    case SolverSurface::kWall:
      return "any wall";
    case SolverSurface::kPlane:
      return "one plane";
    case SolverSurface::kNoPlane:
      return "no plane";
    default:
      return "any scene";
  }
}

using Motion = SolverMotion;
using Surface = SolverSurface;
constexpr bool kAffine = true, kPoint = false;

constexpr Solver kRows[] = {
    {"relpose_1ac_ground", "1AC ground", "1ac_ground", 1, kAffine, Motion::kPlanar,
     Surface::kGround, "yaw, t", "camera height", 62,
     functions<&relpose_1ac_ground, &relpose_nac_ground>(), PoolUse::kOn,
     &relpose_1ac_ground_batch},
    {"relpose_1ac_ground_rapid", "1AC ground rapid", "", 1, kAffine, Motion::kPlanar,
     Surface::kGround, "yaw, t", "camera height", 82,
     functions<&relpose_1ac_ground_rapid, &relpose_nac_ground_rapid>()},
    {"relpose_1ac_side_wall", "1AC side wall", "1ac_side", 1, kAffine, Motion::kPlanar,
     Surface::kSideWall, "yaw, t", "wall distance", 53,
     functions<&relpose_1ac_side_wall, &relpose_nac_side_wall>(), PoolUse::kOff},
    {"relpose_1ac_side_wall_rapid", "1AC side wall rapid", "", 1, kAffine, Motion::kPlanar,
     Surface::kSideWall, "yaw, t", "wall distance", 78,
     functions<&relpose_1ac_side_wall_rapid, &relpose_nac_side_wall_rapid>()},
    {"relpose_1ac_front_wall", "1AC front wall", "1ac_front", 1, kAffine, Motion::kPlanar,
     Surface::kFrontWall, "yaw, t", "wall distance", 49,
     functions<&relpose_1ac_front_wall, &relpose_nac_front_wall>(), PoolUse::kOff},
    {"relpose_1ac_front_wall_rapid", "1AC front wall rapid", "", 1, kAffine, Motion::kPlanar,
     Surface::kFrontWall, "yaw, t", "wall distance", 77,
     functions<&relpose_1ac_front_wall_rapid, &relpose_nac_front_wall_rapid>()},
    {"relpose_1ac_wall", "1AC wall", "1ac_wall", 1, kAffine, Motion::kPlanar, Surface::kWall,
     "yaw, t, normal", "wall distance", 85, functions<&relpose_1ac_wall, &relpose_nac_wall>(),
     PoolUse::kOff},
    {"relpose_1ac_wall_candidates", "1AC wall candidates", "", 1, kAffine, Motion::kPlanar,
     Surface::kWall, "yaw, ±t, ±normal", "wall distance", 90,
     functions<&relpose_1ac_wall_candidates, nullptr>()},
    {"relpose_1ac_planar", "1AC planar", "1ac_planar", 1, kAffine, Motion::kPlanar, Surface::kAny,
     "yaw, direction", "1", 67, functions<&relpose_1ac_planar, &relpose_nac_planar>(), PoolUse::kOn,
     &relpose_1ac_planar_batch},
    {"relpose_1ac_planar_pitch", "1AC planar pitch", "", 1, kAffine, Motion::kPitched,
     Surface::kAny, "yaw, direction, pitch", "1", 2600,
     functions<&planar_pitch, &nac_planar_pitch>()},
    {"relpose_1ac_planar_focal", "1AC planar focal", "1ac_planar_focal", 1, kAffine,
     Motion::kPlanar, Surface::kAny, "yaw, direction, focal length", "1", 80,
     functions<&planar_focal, &nac_planar_focal>()},
    {"relpose_1ac_vertical", "1AC known vertical", "1ac_vertical", 1, kAffine, Motion::kUpright,
     Surface::kAny, "yaw, direction", "1", 390,
     functions<&relpose_1ac_vertical, &relpose_nac_vertical>()},
    {"relpose_1pc_ackermann", "1PC Ackermann", "1pc", 1, kPoint, Motion::kCircular, Surface::kAny,
     "yaw", "1", 40, functions<&relpose_1pc_ackermann, &relpose_1pc_ackermann>()},
    {"relpose_2pc_ground", "2PC ground", "2pc_ground", 2, kPoint, Motion::kPlanar, Surface::kGround,
     "yaw, t", "camera height", 64, functions<&relpose_2pc_ground, &relpose_2pc_ground>()},
    {"relpose_2pc_planar", "2PC planar", "2pc_planar", 2, kPoint, Motion::kPlanar, Surface::kAny,
     "yaw, direction", "1", 330, functions<&relpose_2pc_planar, nullptr>()},
    {"relpose_3pc_vertical", "3PC vertical", "3pc_vertical", 3, kPoint, Motion::kPlanar,
     Surface::kWall, "yaw, t, normal", "wall distance", 610,
     functions<&relpose_3pc_vertical, &relpose_3pc_vertical>()},
    {"relpose_2ac", "2AC essential", "2ac_essential", 2, kAffine, Motion::kAny, Surface::kAny,
     "R, direction", "1", 8100, functions<&relpose_2ac, &relpose_nac>()},
    {"homography_2ac", "2AC", "2ac", 2, kAffine, Motion::kAny, Surface::kPlane, "H (R, t, normal)",
     "plane distance", 4400, functions<&homography_2ac, &homography_2ac, Gives::kHomographies>()},
    {"homography_4pc", "4PC", "4pc", 4, kPoint, Motion::kAny, Surface::kPlane, "H (R, t, normal)",
     "plane distance", 1100, functions<&homography_4pc, &homography_4pc, Gives::kHomographies>()},
    {"essential_5pc", "5PC", "5pc", 5, kPoint, Motion::kAny, Surface::kAny, "E (R, direction)", "1",
     6700, functions<&essential_5pc, nullptr, Gives::kEssentials>()},
    {"essential_8pc", "8PC", "8pc", 8, kPoint, Motion::kAny, Surface::kNoPlane, "E (R, direction)",
     "1", 1400, functions<&essential_8pc, &essential_8pc, Gives::kEssentials>()},
};

}  // namespace

std::string Solver::assumptions() const {
  return std::string(text(motion)) + ", " + std::string(text(surface));
}

const char* Solver::pool_key() const {
  constexpr std::string_view kPrefix = "relpose_1ac_";
  return name.data() + kPrefix.size();
}

const std::vector<Solver>& solvers() {
  static const std::vector<Solver> kSolvers(std::begin(kRows), std::end(kRows));
  return kSolvers;
}

const Solver& solver_named(std::string_view name) {
  const auto found = std::find_if(solvers().begin(), solvers().end(),
                                  [name](const Solver& solver) { return solver.name == name; });
  if (found == solvers().end()) {
    throw std::invalid_argument("solver = '" + std::string(name) +
                                "', must be a name of the list of solvers");
  }
  return *found;
}

std::string solver_table() {
  std::string table =
      "| solver | correspondences | assumptions | unknowns | candidates | unit of t | metric | ns "
      "|\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const Solver& solver : solvers()) {
    const std::string points = solver.sample == 1 ? " point" : " points";
    const std::string kind = solver.affine ? " affine" : points;
    const std::string cells[] = {"`" + std::string(solver.name) + "`",
                                 std::to_string(solver.sample) + kind,
                                 solver.assumptions(),
                                 std::string(solver.unknowns),
                                 std::to_string(solver.run.max_candidates),
                                 std::string(solver.unit),
                                 solver.metric() ? "yes" : "no",
                                 std::to_string(solver.typical_ns)};
    for (const std::string& cell : cells) table += "| " + cell + " ";
    table += "|\n";
  }
  return table;
}

}  // namespace oneac
