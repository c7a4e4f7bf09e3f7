#pragma once

#include "oneac/geometry/affine_correspondence.h"
#include "oneac/study/trial_random.h"

#include <Eigen/Core>

namespace oneac {

/// What a level of noise means. The paper says of the points "vectors with lengths given in
/// pixels", and of the affinities "the angle of the rotation matrices are perturbed with a small
/// angle": open is how those errors are distributed and whether the two rotations have errors of
/// their own. Points: a vector of exactly the level's length in any direction, except in `normal`.
enum class NoiseShape {
  kUniform,  ///< angles and shares uniform in ± level
  kFixed,    ///< angles and shares of exactly the level, either sign
  kNormal,   ///< zero-mean normal with the level as standard deviation; points per axis
  kCommon,   ///< as uniform, but one error for the angles of both U and V in A = U S Vᵀ
};

/// Noise of a correspondence; all zero: exact.
struct NoiseLevel {
  double point_px = 0.0;       ///< on the point of the second view [px]
  double rotation_deg = 0.0;   ///< on the angle of each rotation of the affinity's SVD [deg]
  double scale_percent = 0.0;  ///< on each singular value of the affinity [% of it]
};

/// The study's focal length [px]: turns pixels into normalised coordinates.
constexpr double kStudyFocalPx = 1000.0;

/// A = R(first) diag(large, small) R(second), with rotations of the plane; det A > 0.
struct AffinityFactors {
  double first = 0.0;   ///< [rad]
  double large = 1.0;   ///< |large| ≥ |small|
  double small = 1.0;   ///< negative for a mirrored affinity
  double second = 0.0;  ///< [rad]

  [[nodiscard]] Eigen::Matrix2d matrix() const;
};
[[nodiscard]] AffinityFactors affinity_factors(const Eigen::Matrix2d& A);

/// A with its two angles and its two singular values disturbed, each by an error of its own
/// (but see NoiseShape::kCommon).
[[nodiscard]] Eigen::Matrix2d noisy_affinity(const Eigen::Matrix2d& A, const NoiseLevel& level,
                                             NoiseShape shape, TrialRandom& random);

/// The correspondence of x1 under H, disturbed as in the paper: noise on the point of the second
/// view, the affinity recomputed from the true H and the noisy point (eq. (5)), then disturbed
/// through its SVD.
/// @pre H maps x1 before the second camera
[[nodiscard]] AffineCorrespondence noisy_correspondence(const Eigen::Matrix3d& H,
                                                        const Eigen::Vector2d& x1,
                                                        const NoiseLevel& level, NoiseShape shape,
                                                        TrialRandom& random);

}  // namespace oneac
