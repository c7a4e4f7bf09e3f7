#pragma once

#include "oneac/geometry/relative_pose.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

namespace oneac {

/// What one landmark says about the length of a step.
struct LengthVote {
  double length = 0.0;
  double point_sigma = 0.0;  ///< 1σ of it by the noise of the points
  double depth_sigma = 0.0;  ///< relative 1σ of the depth, and so of the true length
  /// [length/rad] what a turn that is wrong, and shifts all points alike, adds to it.
  Eigen::Vector2d lever = Eigen::Vector2d::Zero();

  /// 1σ when the true length is known. Not of the vote's own length: what votes for zero, traffic
  /// ahead, would otherwise look most certain.
  [[nodiscard]] double sigma(double true_length) const;
};

/// Length of t that brings the point X of the first view closest to x in the second; empty without
/// parallax.
/// @param depth_sigma  relative 1σ of the depth of X
[[nodiscard]] std::optional<LengthVote> length_vote(const RelativePose& unit_step,
                                                    const Eigen::Vector3d& X,
                                                    const Eigen::Vector2d& x, double depth_sigma,
                                                    double sigma);

struct RobustMean {
  double value = 0.0;
  double relative_sigma = 0.0;  ///< from the scatter of the votes
  std::size_t support = 0;
  Eigen::Vector2d lever = Eigen::Vector2d::Zero();  ///< mean of those of the votes
  double depth_sigma = 0.0;                         ///< relative, mean of those of the votes
};

/// [rad] 1σ of the turn between two frames beside what two views say of it: calibration and
/// rolling shutter leave it, and far points turn it into lengths.
constexpr double kTurnSigma = 1.5e-4;

/// Weighted mean about the median (Geman–McClure weights at 2σ). @pre not empty
[[nodiscard]] RobustMean robust_mean(std::vector<LengthVote> votes);

}  // namespace oneac
