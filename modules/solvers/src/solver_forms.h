#pragma once

#include "oneac/geometry/essential.h"
#include "oneac/solvers/essential_8pc.h"
#include "oneac/solvers/registry.h"
#include "oneac/solvers/relpose_1ac_planar_pitch.h"
#include "oneac/solvers/relpose_1ac_vertical.h"
#include "oneac/solvers/wall_pose.h"

#include <cstddef>
#include <type_traits>
#include <utility>

// Makes the columns of a row of the list from the solver's own functions.
namespace oneac::internal {

/// What the solutions of a solver are.
enum class Gives { kPoses, kHomographies, kEssentials };

inline PlanePose with_plane(const PlanarPose& s) {
  return {s.pose(), Eigen::Vector3d::UnitY()};
}
inline PlanePose with_plane(const WallPose& s) {
  return {s.pose(), s.normal()};
}
inline PlanePose with_plane(const PitchedPose& s) {
  return {s.pose(), Eigen::Vector3d::UnitY()};
}
inline PlanePose with_plane(const UprightPose& s) {
  return {s.pose(), Eigen::Vector3d::UnitY()};
}

/// The solver's own solution set, whatever form its parameters have.
template <auto kSolve>
auto call(AcSpan acs) {
  using Function = decltype(kSolve);
  if constexpr (std::is_invocable_v<Function, AcSpan, const double*>) {
    return kSolve(acs, nullptr);
  } else if constexpr (std::is_invocable_v<Function, AcSpan>) {
    return kSolve(acs);
  } else {
    return kSolve(acs[0]);
  }
}

template <auto kSolve>
std::size_t count(AcSpan acs) {
  return call<kSolve>(acs).size();
}

inline PlanePose with_plane(const RelativePose& T) {
  return {T, Eigen::Vector3d::UnitY()};
}

template <auto kSolve, Gives kGives, class Take>
void for_each_pose(AcSpan acs, Take&& take) {
  for (const auto& solution : call<kSolve>(acs)) {
    if constexpr (kGives == Gives::kPoses) {
      take(with_plane(solution));
    } else if constexpr (kGives == Gives::kHomographies) {
      for (const PlanePose& pose : poses_from_homography(solution, acs)) take(pose);
    } else {
      for (const RelativePose& pose : pose_from_essential(solution, acs)) take(PlanePose{pose});
    }
  }
}

template <auto kSolve, Gives kGives>
PoseSet poses(AcSpan acs) {
  PoseSet set;
  for_each_pose<kSolve, kGives>(acs, [&](const PlanePose& pose) { set.push_back(pose); });
  return set;
}

template <auto kSolve, Gives kGives>
std::size_t put(AcSpan acs, PlanePose* out) {
  std::size_t count = 0;
  for_each_pose<kSolve, kGives>(acs, [&](const PlanePose& pose) { out[count++] = pose; });
  return count;
}

inline void add_essential(const RelativePose& T, EssentialSet& set) {
  const double length = T.t.norm();
  if (length > 0.0) set.push_back(essential_matrix({T.R, T.t / length}));
}

template <auto kSolve, Gives kGives>
EssentialSet essentials(AcSpan acs) {
  EssentialSet set;
  for (const auto& solution : call<kSolve>(acs)) {
    if constexpr (kGives == Gives::kPoses) {
      add_essential(with_plane(solution).motion, set);
    } else if constexpr (kGives == Gives::kHomographies) {
      for (const PlanePose& pose : poses_from_homography(solution, acs)) {
        add_essential(pose.motion, set);
      }
    } else {
      set.push_back(solution);
    }
  }
  return set;
}

template <auto kSolve>
PlanarPoseSet planar(const AffineCorrespondence& ac) {
  PlanarPoseSet set;
  for (const PlanarPose& pose : kSolve(ac)) set.push_back(pose);
  return set;
}

/// The columns of a row from its minimal and its least-squares function (nullptr: none).
template <auto kMinimal, auto kLeastSquares, Gives kGives = Gives::kPoses>
constexpr SolverFunctions functions() {
  using Set = decltype(call<kMinimal>(AcSpan()));
  using Solution = std::decay_t<decltype(std::declval<Set>()[0])>;
  SolverFunctions run{static_cast<int>(Set::kCapacity),
                      &count<kMinimal>,
                      &essentials<kMinimal, kGives>,
                      &poses<kMinimal, kGives>,
                      &put<kMinimal, kGives>,
                      nullptr,
                      nullptr};
  if constexpr (kLeastSquares != nullptr) run.least_squares = &poses<kLeastSquares, kGives>;
  constexpr bool kOfOne = std::is_invocable_v<decltype(kMinimal), const AffineCorrespondence&>;
  if constexpr (kOfOne && std::is_base_of_v<PlanarPose, Solution>) {
    if constexpr (Set::kCapacity <= PlanarPoseSet::kCapacity) run.planar = &planar<kMinimal>;
  }
  return run;
}

}  // namespace oneac::internal
