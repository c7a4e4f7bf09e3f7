#pragma once

#include "math/epipolar_rows.h"

#include "oneac/geometry/triangulation.h"

#include <cstdlib>

namespace oneac::internal {

/// What the correspondences that take part say about the sign of t.
struct SignVote {
  int balance = 0;  ///< below zero: most of them want it flipped
  int voters = 0;   ///< those that lie before both cameras for one of the signs

  /// @param scale  of the points, where their focal length is not one
  SignVote(const RelativePose& T, AcSpan acs, const double* weights, double scale = 1.0) {
    for (std::size_t i = 0; i < acs.size(); ++i) {
      if (!counts(acs, weights, i)) continue;
      const int vote = cheirality(T, scale * acs[i].x1, scale * acs[i].x2);
      balance += vote;
      voters += std::abs(vote);
    }
  }
};

}  // namespace oneac::internal
