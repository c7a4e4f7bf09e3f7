#include "point_solver_tools.h"

#include "oneac/solvers/essential_5pc.h"
#include "oneac/solvers/essential_8pc.h"

#include <gtest/gtest.h>

#include <opengv/relative_pose/CentralRelativeAdapter.hpp>
#include <opengv/relative_pose/methods.hpp>

namespace oneac {
namespace {

using namespace test;

/// Bearing vectors of the points. OpenGV's convention: the adapter's (R12, t12) map view 2 to view
/// 1, and its essential matrices are those of x1ᵀ E x2; handing it the views swapped gives ours.
struct Bearings {
  opengv::bearingVectors_t first, second;

  explicit Bearings(const std::vector<AffineCorrespondence>& acs) {
    for (const auto& ac : acs) {
      first.push_back(ac.x1.homogeneous().normalized());
      second.push_back(ac.x2.homogeneous().normalized());
    }
  }
};

/// Smallest error of either E or its transpose: the tests do not depend on OpenGV's direction.
template <class Candidates>
double nearest(const Candidates& candidates, const Eigen::Matrix3d& E) {
  double least = 10.0;
  for (const Eigen::Matrix3d& candidate : candidates) {
    least =
        std::min({least, essential_error(candidate, E), essential_error(candidate, E.transpose())});
  }
  return least;
}

std::vector<Eigen::Matrix3d> stewenius(const std::vector<AffineCorrespondence>& acs) {
  const Bearings bearings(acs);
  opengv::relative_pose::CentralRelativeAdapter adapter(bearings.first, bearings.second);
  std::vector<Eigen::Matrix3d> real;
  for (const auto& E : opengv::relative_pose::fivept_stewenius(adapter)) {
    if (E.imag().norm() < 1e-7 * E.real().norm()) real.push_back(E.real());
  }
  return real;
}

TEST(OpenGv, FivePointCandidatesAreTheSameOnNoisyPoints) {
  SceneGenerator scene(1);
  int same_candidates = 0, same_count_as_nister = 0;
  for (int i = 0; i < 300; ++i) {
    auto acs = scattered(scene, scene.general_motion(), 5);
    for (auto& ac : acs) ac = scene.with_noise(ac, 1e-3, 0.0);
    const auto ours = essential_5pc(acs);
    const auto theirs = stewenius(acs);
    bool same = ours.size() == theirs.size();
    for (const Eigen::Matrix3d& E : ours) same = same && nearest(theirs, E) < 1e-5;
    for (const Eigen::Matrix3d& E : theirs) same = same && nearest(ours, E) < 1e-5;
    same_candidates += same ? 1 : 0;
    const Bearings bearings(acs);
    opengv::relative_pose::CentralRelativeAdapter adapter(bearings.first, bearings.second);
    const auto nister = opengv::relative_pose::fivept_nister(adapter);  // less exact than ours
    same_count_as_nister += ours.size() == nister.size() ? 1 : 0;
  }
  EXPECT_GE(same_candidates, 295);  // the rest: nearly double roots
  EXPECT_GE(same_count_as_nister, 285);
}

TEST(OpenGv, EightPointIsTheSame) {
  SceneGenerator scene(2);
  for (int i = 0; i < 300; ++i) {
    const auto acs = scattered(scene, scene.general_motion(), 8);
    const Bearings bearings(acs);
    opengv::relative_pose::CentralRelativeAdapter adapter(bearings.first, bearings.second);
    const Eigen::Matrix3d theirs = opengv::relative_pose::eightpt(adapter);
    const auto ours = essential_8pc(acs);
    ASSERT_EQ(ours.size(), 1u);
    EXPECT_LT(nearest(ours, theirs), 1e-6) << "scene " << i << " of seed 2";
  }
}

}  // namespace
}  // namespace oneac
