#pragma once

#include "oneac/geometry/relative_pose.h"
#include "oneac/solvers/span.h"

#include <Eigen/Core>

#include <limits>
#include <vector>

namespace oneac {

/// What the camera did between two views.
enum class MotionModel {
  kStill,        ///< x2 = x1
  kRotation,     ///< x2 = π(R x1)
  kTranslation,  ///< an epipolar geometry with depths in front of the camera
};
/// "still", "rotation" or "translation".
[[nodiscard]] const char* to_string(MotionModel model);

/// What is known of the motion before the points are looked at: inertia,
/// sensors. Defaults: nothing.
struct MotionPrior {
  static constexpr double kUnknown = std::numeric_limits<double>::infinity();

  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< expected t/|t|, camera frame; or zero
  double direction_sigma = kUnknown;                    ///< [rad] 1σ of it, either sense
  double length = 0.0;                                  ///< expected |t| [camera heights]
  double length_sigma = kUnknown;                       ///< 1σ of it [camera heights]

  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

/// Costs in nats, so that sums of them are log-likelihoods.
/// validate() throws std::invalid_argument.
struct MotionEvidenceOptions {
  double sigma = 3.5e-4;       ///< [-] 1σ of a coordinate where a point brings none of its own
  double affine_sigma = 0.08;  ///< [-] 1σ of det A of a tracked patch
  double outlier_cost = 6.0;   ///< log of (20 px)² over 2πσ² with σ = 0.25 px, less the prior
  double depth_cost = 3.0;     ///< the same along one line: a depth of its own
  double ground_cost = 0.7;    ///< log 2: a point of the road needs no depth, just to be of it
  double mover_cost = 10.0;    ///< something rigid moves before a camera at rest; once in 20 000
  double slope = 0.012;        ///< [rad] 1σ of road and levelling against each other (0.7°)
  double road_below = 0.25;    ///< [1/camera heights] inverse depth from which what stands is road
                               ///< and not the vehicle ahead: six metres at a height of 1.5 m
  double decided = 3.0;        ///< log-odds needed for a translation: 20 to 1

  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

/// Where the log-odds of a translation came from [nats].
struct MotionReasons {
  double road = 0.0;        ///< points that move as the road below a moving camera does
  double resting = 0.0;     ///< near points that stand although the camera were to move (≤ 0)
  double dissent = 0.0;     ///< the others: depths of their own instead of outliers
  double affinity = 0.0;    ///< growth of the patches on the road
  double kinematics = 0.0;  ///< direction: along the road, and as expected (≤ 0)
  double inertia = 0.0;     ///< length as expected, against rest
  bool one_mover = false;   ///< a single body moving before a camera at rest explains them better
};

/// The choice between still, rotation and rotation with translation.
struct MotionEvidence {
  MotionModel model = MotionModel::kStill;
  RelativePose pose;           ///< camera frame; |t| = 1 for kTranslation, else 0
  double log_odds = 0.0;       ///< translation against the better of the others
  double rotation_odds = 0.0;  ///< rotation against still
  /// Direction in which `length` was measured, unit: of the translation, else that of the prior.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  double length = 0.0;  ///< |t| by the road's points [camera heights]; negative: backwards
  double length_sigma = MotionPrior::kUnknown;  ///< 1σ of it; infinite when no road was seen
  MotionReasons reasons;

  /// |t| in its own sigmas.
  [[nodiscard]] double significance() const {
    return length_sigma < MotionPrior::kUnknown ? std::abs(length) / length_sigma : 0.0;
  }
};

/// What is compared: a rotation that leaves the camera in its place, and motions.
struct MotionHypotheses {
  Eigen::Matrix3d R_rest = Eigen::Matrix3d::Identity();
  std::vector<RelativePose> moving;  ///< |t| = 1 of either sign; may be empty
};

/// Weighs still, rotation and translation by the cost of every correspondence under each.
///
/// A point that dissents from the rotation is an outlier (outlier_cost), has a depth of its own on
/// the common epipolar line (depth_cost) or lies on the road, whose motion follows from |t| alone
/// (ground_cost). Far points cost the same either way. Nothing below the horizon is farther than
/// the road: near points that rest contradict a translation. A body that moves before a camera at
/// rest explains dissent as well as a translation does when it is narrower than the picture; the
/// road decides then. Besides `moving`, the direction on which the dissenting points agree given
/// R_rest is tried, and that of the prior.
/// @param acs          normalised correspondences of the tilted camera, finite
/// @param sigmas       1σ of a coordinate of each point [-], as many as acs, or none
/// @param R_level_cam  removes the camera's tilt
/// @cost               about 20 µs for 600 points and three directions
[[nodiscard]] MotionEvidence judge_motion(AcSpan acs, const std::vector<double>& sigmas,
                                          const MotionHypotheses& hypotheses,
                                          const Eigen::Matrix3d& R_level_cam,
                                          const MotionPrior& prior,
                                          const MotionEvidenceOptions& options);

/// The direction t on which points that dissent from a rotation agree: the unit vector that is most
/// nearly in all their epipolar planes, t·(x2 × R x1) = 0, sign by cheirality. Zero where fewer
/// than three dissent.
[[nodiscard]] Eigen::Vector3d direction_of_dissent(AcSpan acs, const Eigen::Matrix3d& R,
                                                   double sigma);

}  // namespace oneac
