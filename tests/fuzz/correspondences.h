#pragma once

#include "fuzz.h"

#include "oneac/geometry/affine_correspondence.h"
#include "oneac/geometry/relative_pose.h"

#include <Eigen/Core>

#include <vector>

namespace oneac::fuzz {

/// Correspondences of any doubles.
[[nodiscard]] inline std::vector<AffineCorrespondence> correspondences(Numbers& numbers,
                                                                       std::size_t count) {
  std::vector<AffineCorrespondence> acs(count);
  for (AffineCorrespondence& ac : acs) {
    ac.x1 << numbers.number(), numbers.number();
    ac.x2 << numbers.number(), numbers.number();
    ac.A << numbers.number(), numbers.number(), numbers.number(), numbers.number();
  }
  return acs;
}

inline void check_rotation(const Eigen::Matrix3d& R) {
  constexpr double kTolerance = 1e-6;
  check(R.allFinite(), "a rotation is finite");
  check((R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < kTolerance,
        "a rotation is orthonormal");
}

inline void check_pose(const RelativePose& pose) {
  check_rotation(pose.R);
  check(pose.t.allFinite(), "a translation is finite");
}

}  // namespace oneac::fuzz
