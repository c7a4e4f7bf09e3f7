#pragma once

#include "oneac/robust/motion_evidence.h"

#include <Eigen/Core>

#include <vector>

namespace oneac::internal {

/// A point's motion beside a rotation, split along the epipolar line of a translation, in its own
/// sigmas; |t| is in camera heights.
struct Flow {
  float along = 0.0F;        ///< in the direction of t: a point before the camera has ≥ 0
  float across = 0.0F;       ///< of the epipolar line
  float per_depth = 0.0F;    ///< of `along` by |t| and inverse depth
  float road = 0.0F;         ///< inverse depth of the road at this pixel; ≤ 0 above the horizon
  float growth = 0.0F;       ///< of the patch beside the rotation's
  float road_growth = 0.0F;  ///< the same of the road, by |t|
  float x = 0.0F;            ///< place in the second view, right [-]
};

/// x2 − π(R x1) of each point in its sigmas; (100, 100) behind the camera.
[[nodiscard]] std::vector<Eigen::Vector2f> residuals(const Eigen::Matrix3d& R, AcSpan acs,
                                                     const std::vector<double>& sigmas,
                                                     double sigma);

/// Cost of all points when the camera did not travel: noise or outliers.
[[nodiscard]] double resting_cost(const std::vector<Eigen::Vector2f>& residuals,
                                  const MotionEvidenceOptions& options);

[[nodiscard]] std::vector<Flow> flows(const RelativePose& pose, AcSpan acs,
                                      const std::vector<double>& sigmas,
                                      const Eigen::Matrix3d& R_level_cam, double sigma);

constexpr float kDissents = 4.0F;  ///< [sigmas] along the line, beyond noise
constexpr float kAgrees = 3.0F;    ///< [sigmas] across it

/// Whether the dissenting points spread over less of the picture than all of them.
[[nodiscard]] bool is_narrow(const std::vector<Flow>& flows);

/// What the points say of one direction of travel.
struct MotionScore {
  double gain = 0.0;       ///< cost at rest minus cost under the translation [nats]
  bool backwards = false;  ///< the sign of t was wrong
  double length = 0.0;     ///< [camera heights]
  double length_sigma = MotionPrior::kUnknown;
  MotionReasons reasons;
};

/// The score at the length that explains the points best.
[[nodiscard]] MotionScore best_score(std::vector<Flow> flows,
                                     const std::vector<Eigen::Vector2f>& resting,
                                     const MotionEvidenceOptions& options);

}  // namespace oneac::internal
