#pragma once

#include "row_writer.h"

#include "oneac/geometry/essential.h"
#include "oneac/solvers/essential_8pc.h"
#include "oneac/solvers/registry.h"

#include <cstddef>
#include <type_traits>
#include <utility>

// Makes the columns of a row of the list from the solver's own functions.
namespace oneac::internal {

/// What the solutions of a solver are.
enum class Gives { kPoses, kHomographies, kEssentials };

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
void rows(AcSpan acs, std::size_t sample, const PoseRows& out) {
  RowWriter writer(out);
  for (std::size_t first = 0; first < acs.size(); first += sample) {
    const AcSpan one(acs.begin() + first, sample);
    if constexpr (kGives == Gives::kPoses) {
      for (const auto& solution : call<kSolve>(one)) writer.add(solution);
    } else {
      for_each_pose<kSolve, kGives>(one, [&](const PlanePose& pose) { writer.add(pose); });
    }
    writer.finish_sample();
  }
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
                      &rows<kMinimal, kGives>,
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
