#pragma once

#include "oneac/loops/loop_keyframe.h"
#include "oneac/loops/pose_graph.h"

#include <Eigen/Core>

#include <vector>

namespace oneac {

/// Relative 1σ of what all steps of a drive have in common.
struct SharedErrors {
  double length = 0.0;  ///< of lengths: the camera's height, the size of tyres
  double turn = 0.0;    ///< of turns: the focal length
};

/// How sure the keyframes of a closed graph are, one covariance each of (θ, p) in its frame,
/// R ← exp([θ]×) R, p ← p + δp [rad², rad m, m²]; zero for the first of a frame.
///
/// To first order, what errors of steps and loops make of the least squares that closed the graph:
/// their own, independent ones (blocks of the inverse of its normal equations, found along their
/// sparsity), and those that many have in common (`shared`, and the rest of a length's error, which
/// lasts for a stretch of the way), each carried through the solution as a whole.
/// @param keyframes  as the graph was solved for
/// @pre every keyframe is joined to the first of its frame by steps or loops
[[nodiscard]] std::vector<Eigen::Matrix<double, 6, 6>> closed_covariances(
    const std::vector<LoopKeyframe>& keyframes, const ClosedGraph& graph,
    const SharedErrors& shared);

}  // namespace oneac
