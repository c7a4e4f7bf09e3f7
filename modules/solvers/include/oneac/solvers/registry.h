#pragma once

#include "oneac/solvers/batch.h"
#include "oneac/solvers/homography_decomposition.h"
#include "oneac/solvers/planar_pose.h"
#include "oneac/solvers/solution_set.h"
#include "oneac/solvers/span.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace oneac {

/// Motions that solvers assume. All but kAny want levelled cameras: Y along gravity in both views
/// (kPitched: in the first one). kUpright: a yaw and any translation.
enum class SolverMotion { kPlanar, kPitched, kCircular, kUpright, kAny };

/// What the correspondences of a sample lie on; kAny and kNoPlane: each on a plane of its own.
enum class SolverSurface { kGround, kSideWall, kFrontWall, kWall, kPlane, kAny, kNoPlane };

/// Whether a solver makes hypotheses of the one-AC consensus unless the options say otherwise.
enum class PoolUse { kNever, kOff, kOn };

/// At most ten: the five-point solver's.
using EssentialSet = SolutionSet<Eigen::Matrix3d, 10>;
using PoseSet = SolutionSet<PlanePose, 10>;
using PlanarPoseSet = SolutionSet<PlanarPose, 2>;
using BatchSolver = std::size_t (*)(const AcArrays&, const PlanarPoseArrays&, SimdLevel);

/// Where poses go, `room` for each sample: R row by row (9), t (3), n (3). What a sample leaves of
/// its room becomes no motion: the identity, zero, zero. The arrays must not overlap.
struct PoseRows {
  double* R;
  double* t;
  double* n;
  std::int64_t* count;  ///< of each sample; at most `room`, what a set holds beyond is left out
  std::size_t room;
};

/// A solver's functions in the forms that its callers walk. No form allocates.
struct SolverFunctions {
  int max_candidates;                         ///< capacity of its solution set
  std::size_t (*count)(AcSpan sample);        ///< the bare solver: how many solutions
  EssentialSet (*essentials)(AcSpan sample);  ///< |E| = √2; homographies: of the poses below
  /// Poses in the row's unit. Of matrices those motions that have most of the sample before both
  /// cameras. `n` is the plane's normal, and means nothing where the solver knows no plane.
  PoseSet (*poses)(AcSpan sample);
  /// `poses` of many samples, one after the other in `acs`, written where they shall be: a hundred
  /// thousand sets would be mostly room that is made ready in vain.
  void (*rows)(AcSpan acs, std::size_t sample, const PoseRows& out);
  PoseSet (*least_squares)(AcSpan acs);  ///< `poses` of any number ≥ sample; null: no such form
  PlanarPoseSet (*planar)(const AffineCorrespondence& ac);  ///< null: no planar motion from one
};

/// One row of the list of solvers: all that a caller has to know. Whatever offers, compares, runs
/// or describes solvers walks this list.
struct Solver {
  std::string_view name;      ///< of the function, header and page docs/solvers/<name>.md
  std::string_view label;     ///< in figures and their files; the paper's where it has one
  std::string_view method;    ///< short name of its initialiser; empty: none
  std::size_t sample;         ///< correspondences of the minimal form, at most kLargestSample
  bool affine;                ///< affine correspondences, else points
  SolverMotion motion;        ///< assumed
  SolverSurface surface;      ///< assumed
  std::string_view unknowns;  ///< what it solves for
  std::string_view unit;      ///< of the translation
  int typical_ns;             ///< [ns] as docs/solvers/README.md says it was measured
  SolverFunctions run;        ///< made by functions<…>() of registry.cpp
  PoolUse pool = PoolUse::kNever;
  BatchSolver batch = nullptr;  ///< several at a time, for the pool; null: one by one

  /// Takes correspondences of a levelled camera.
  [[nodiscard]] bool levelled() const { return motion != SolverMotion::kAny; }
  /// Length known as soon as the camera height is.
  [[nodiscard]] bool metric() const { return surface == SolverSurface::kGround; }
  /// About motion and scene, e.g. "planar motion, ground".
  [[nodiscard]] std::string assumptions() const;
  /// Among the parameters of the consensus, e.g. "side_wall"; ends in a null character.
  [[nodiscard]] const char* pool_key() const;
};

constexpr std::size_t kLargestSample = 8;

/// Every solver of the module, in the order of the documentation.
[[nodiscard]] const std::vector<Solver>& solvers();

/// The row of a name. @throws std::invalid_argument when there is none
[[nodiscard]] const Solver& solver_named(std::string_view name);

/// The solvers as a Markdown table, a row each, ending in a newline.
[[nodiscard]] std::string solver_table();

}  // namespace oneac
