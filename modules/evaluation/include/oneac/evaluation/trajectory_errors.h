#pragma once

#include "oneac/evaluation/statistics.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace oneac {

/// What may be moved before absolute positions are compared.
enum class Alignment {
  kNone,  ///< nothing
  kSe3,   ///< rotation and translation
  kSim3   ///< and scale
};

/// "none", "se3" or "sim3". @throws std::invalid_argument naming the value and the choices
[[nodiscard]] Alignment alignment_from_name(const std::string& name);
/// The inverse of alignment_from_name().
[[nodiscard]] std::string name_of(Alignment alignment);

/// y ≈ scale R x + t.
struct Similarity {
  double scale = 1.0;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();

  /// scale R x + t.
  [[nodiscard]] Eigen::Vector3d operator*(const Eigen::Vector3d& x) const {
    return scale * (R * x) + t;
  }
};

/// The same number of poses of both, row by row the same moment, T_world_body [m].
struct MatchedTrajectories {
  std::vector<Eigen::Isometry3d> estimate;
  std::vector<Eigen::Isometry3d> reference;
};

/// Errors over the subsequences of fixed lengths of the reference, as KITTI's odometry benchmark
/// defines them (every fifth frame is a start): lengths 100, 200 … 800 m, or 20, 40 … 100 m when
/// the drive is too short for the first.
struct SubsequenceErrors {
  std::size_t count = 0;
  double translation = 0.0;  ///< t_rel: mean of |error| / length [-]
  double rotation = 0.0;     ///< r_rel: mean of angle / length [rad/m]
};

/// What is said about a trajectory. An optional is empty where the drive does not define it.
struct TrajectoryErrors {
  std::size_t frames = 0;
  double length = 0.0;  ///< path of the reference [m]
  Alignment alignment = Alignment::kSe3;
  double aligned_scale = 1.0;                     ///< what kSim3 multiplied the estimate by
  Statistics ape;                                 ///< absolute position error after alignment [m]
  std::optional<Statistics> rpe_translation;      ///< per pair of consecutive rows [m]
  std::optional<Statistics> rpe_rotation;         ///< [rad]
  std::optional<SubsequenceErrors> subsequences;  ///< empty for drives of up to 20 m
  std::optional<double> scale_error;  ///< path of estimate / of reference − 1; before alignment
};

/// Least-squares alignment of x to y                                            [Umeyama 1991].
///
/// A standing trajectory (no spread) gives rotation identity and scale 1.
/// @param x, y  3×n, n ≥ 1 columns
[[nodiscard]] Similarity align(const Eigen::Matrix3Xd& x, const Eigen::Matrix3Xd& y,
                               Alignment alignment);

/// Length of the path through the positions [m].
[[nodiscard]] double path_length(const std::vector<Eigen::Isometry3d>& poses);

/// KITTI's t_rel and r_rel (docs/conventions.md); empty where the path is too short for any length.
[[nodiscard]] std::optional<SubsequenceErrors> subsequence_errors(
    const MatchedTrajectories& matched);

/// @throws std::invalid_argument when the sizes differ or are zero
[[nodiscard]] TrajectoryErrors trajectory_errors(const MatchedTrajectories& matched,
                                                 Alignment alignment);

}  // namespace oneac
