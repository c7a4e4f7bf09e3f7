#include "oneac/study/method.h"

#include "oneac/solvers/homography_2ac.h"
#include "oneac/solvers/homography_4pc.h"
#include "oneac/solvers/relpose_1ac_front_wall.h"
#include "oneac/solvers/relpose_1ac_ground.h"
#include "oneac/solvers/relpose_1ac_side_wall.h"
#include "oneac/solvers/relpose_1ac_wall.h"

#include <array>
#include <cstddef>

namespace oneac {
namespace {

using Candidates = SolutionSet<PlanePose, 2>;

template <std::size_t N>
[[nodiscard]] Candidates of_walls(const SolutionSet<WallPose, N>& found) {
  Candidates candidates;
  for (const WallPose& pose : found) candidates.push_back({pose.pose(), pose.normal()});
  return candidates;
}

[[nodiscard]] Candidates of_ground(const SolutionSet<PlanarPose, 1>& found) {
  Candidates candidates;
  for (const PlanarPose& pose : found) {
    candidates.push_back({pose.pose(), Eigen::Vector3d::UnitY()});
  }
  return candidates;
}

[[nodiscard]] Candidates of_homography(const SolutionSet<Eigen::Matrix3d, 1>& found, AcSpan acs) {
  return found.empty() ? Candidates() : poses_from_homography(found[0], acs);
}

struct MethodEntry {
  std::string_view label;
  std::string_view solver;
  std::size_t correspondences;
  Candidates (*solve)(AcSpan);
};

/// In the order of the enumeration.
constexpr std::array<MethodEntry, 8> kMethods{{
    {"1AC ground", "relpose_1ac_ground", 1,
     [](AcSpan s) { return of_ground(relpose_nac_ground(s)); }},
    {"1AC ground rapid", "relpose_1ac_ground_rapid", 1,
     [](AcSpan s) { return of_ground(relpose_nac_ground_rapid(s)); }},
    {"1AC front wall", "relpose_1ac_front_wall", 1,
     [](AcSpan s) { return of_walls(relpose_nac_front_wall(s)); }},
    {"1AC front wall rapid", "relpose_1ac_front_wall_rapid", 1,
     [](AcSpan s) { return of_walls(relpose_nac_front_wall_rapid(s)); }},
    {"1AC side wall", "relpose_1ac_side_wall", 1,
     [](AcSpan s) { return of_walls(relpose_nac_side_wall(s)); }},
    {"1AC vertical", "relpose_1ac_wall", 1, [](AcSpan s) { return of_walls(relpose_nac_wall(s)); }},
    {"4PC", "homography_4pc", 4, [](AcSpan s) { return of_homography(homography_4pc(s), s); }},
    {"2AC", "homography_2ac", 2, [](AcSpan s) { return of_homography(homography_2ac(s), s); }},
}};

[[nodiscard]] const MethodEntry& entry(StudyMethod method) {
  return kMethods[static_cast<std::size_t>(method)];
}

}  // namespace

std::string_view method_label(StudyMethod method) {
  return entry(method).label;
}

std::string_view method_solver(StudyMethod method) {
  return entry(method).solver;
}

SolutionSet<PlanePose, 2> candidates_of(StudyMethod method, AcSpan correspondences, DataUse use) {
  const MethodEntry& chosen = entry(method);
  if (correspondences.size() < chosen.correspondences) return {};
  if (use == DataUse::all) return chosen.solve(correspondences);
  return chosen.solve(AcSpan(correspondences.begin(), chosen.correspondences));
}

}  // namespace oneac
