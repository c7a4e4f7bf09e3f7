#pragma once

#include <array>
#include <string>
#include <string_view>

namespace oneac {

/// What a table says about a solver.
struct SolverInfo {
  std::string_view name;         ///< of the function, header, test and page docs/solvers/<name>.md
  int correspondences;           ///< of the minimal form
  bool affine;                   ///< affine correspondences, else points
  std::string_view assumptions;  ///< about motion and scene
  std::string_view unknowns;     ///< what it solves for
  int max_candidates;            ///< capacity of its solution set
  bool metric;                   ///< length known as soon as the camera height is
  std::string_view unit;         ///< of the translation
  int typical_ns;                ///< as docs/solvers/README.md says it was measured [ns]
};

/// Every solver of the module, in the order of the documentation.
inline constexpr std::array<SolverInfo, 18> kSolvers{{
    {"relpose_1ac_ground", 1, true, "planar motion, ground", "yaw, t", 1, true, "camera height",
     62},
    {"relpose_1ac_ground_rapid", 1, true, "planar motion, ground", "yaw, t", 1, true,
     "camera height", 82},
    {"relpose_1ac_side_wall", 1, true, "planar motion, wall along the road", "yaw, t", 1, false,
     "wall distance", 53},
    {"relpose_1ac_side_wall_rapid", 1, true, "planar motion, wall along the road", "yaw, t", 1,
     false, "wall distance", 78},
    {"relpose_1ac_front_wall", 1, true, "planar motion, wall across the road", "yaw, t", 1, false,
     "wall distance", 49},
    {"relpose_1ac_front_wall_rapid", 1, true, "planar motion, wall across the road", "yaw, t", 1,
     false, "wall distance", 77},
    {"relpose_1ac_wall", 1, true, "planar motion, any wall", "yaw, t, normal", 2, false,
     "wall distance", 85},
    {"relpose_1ac_wall_candidates", 1, true, "planar motion, any wall", "yaw, ±t, ±normal", 4,
     false, "wall distance", 90},
    {"relpose_1ac_planar", 1, true, "planar motion, any scene", "yaw, direction", 1, false, "1",
     67},
    {"relpose_1ac_planar_pitch", 1, true, "planar motion and a pitch, any scene",
     "yaw, direction, pitch", 6, false, "1", 2600},
    {"relpose_1pc_ackermann", 1, false, "circular planar motion, any scene", "yaw", 1, false, "1",
     40},
    {"relpose_2pc_ground", 2, false, "planar motion, ground", "yaw, t", 1, true, "camera height",
     64},
    {"relpose_2pc_planar", 2, false, "planar motion, any scene", "yaw, direction", 2, false, "1",
     330},
    {"relpose_3pc_vertical", 3, false, "planar motion, any wall", "yaw, t, normal", 2, false,
     "wall distance", 610},
    {"homography_2ac", 2, true, "any motion, one plane", "H (R, t, normal)", 1, false,
     "plane distance", 4400},
    {"homography_4pc", 4, false, "any motion, one plane", "H (R, t, normal)", 1, false,
     "plane distance", 1100},
    {"essential_5pc", 5, false, "any motion, any scene", "E (R, direction)", 10, false, "1", 6700},
    {"essential_8pc", 8, false, "any motion, no plane", "E (R, direction)", 1, false, "1", 1400},
}};

/// The solvers as a Markdown table, a row each, ending in a newline.
[[nodiscard]] std::string solver_table();

}  // namespace oneac
