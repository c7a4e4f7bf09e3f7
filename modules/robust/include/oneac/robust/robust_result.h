#pragma once

#include "oneac/geometry/relative_pose.h"
#include "oneac/robust/motion_evidence.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

namespace oneac {

/// What a robust estimate amounts to.
enum class PoseStatus {
  kOk,        ///< pose with a direction of translation
  kOnePlane,  ///< the same, but all inliers lie on one plane: two poses explain the points alike
              ///< and the one nearer to a vehicle's motion was taken
  kPureRotation,  ///< the camera turned or rocked without travelling: R ≠ I, t = 0
  kNoMotion,      ///< the camera stood: R = I, t = 0
  kTooFew,        ///< too few correspondences or inliers: no pose
};
/// One word without comma, as in `relative_poses.csv`.
[[nodiscard]] const char* to_string(PoseStatus status);

/// A pose with a direction of translation came out.
[[nodiscard]] inline bool has_direction(PoseStatus status) {
  return status == PoseStatus::kOk || status == PoseStatus::kOnePlane;
}
/// The camera did not travel.
[[nodiscard]] inline bool is_stationary(PoseStatus status) {
  return status == PoseStatus::kNoMotion || status == PoseStatus::kPureRotation;
}

/// How much work an estimate took.
struct RobustStatistics {
  std::size_t iterations = 0;           ///< minimal samples drawn, or correspondences solved
  std::size_t hypotheses = 0;           ///< models scored
  std::size_t local_optimisations = 0;  ///< non-minimal refits or polishings tried
  std::size_t graph_cuts = 0;           ///< spatial-coherence cuts
};

/// What every robust estimator returns.
struct RobustResult {
  PoseStatus status = PoseStatus::kTooFew;
  RelativePose pose;          ///< camera frame (tilt put back), |t| = 1 or 0
  std::vector<bool> inliers;  ///< one per correspondence
  std::size_t inlier_count = 0;
  double cost = 0.0;  ///< MSAC cost of the result, 0 … number of correspondences
  /// Of (w, b): R = exp([w]×) R̂, t = t̂ + b with b ⊥ t̂ [rad²]; rank 5 when has_direction(status),
  /// of w alone when the camera turned on the spot, zero where not estimated.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  /// Where rest was a question: how sure the answer is, and |t| in camera heights as the road
  /// measures it, with its 1σ; zero is a measurement, too.
  std::optional<MotionEvidence> motion;
  RobustStatistics statistics;
};

}  // namespace oneac
