#pragma once

#include <Eigen/Geometry>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace oneac {

/// How sure a pair is of its motion, and the drive of where it led: a row of covariance.csv.
struct CovarianceRow {
  std::size_t index1 = 0;  ///< as in relative_poses.csv
  std::size_t index2 = 0;
  /// Of (w, t) in the second camera's frame: R ← exp([w]×) R, t ← t + v, t as in
  /// relative_poses.csv [rad², m² where the pair is metric, else of the unit direction]
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  /// [m] 1σ of the position of frame index2 along the axes of the first camera's frame; empty while
  /// nothing is in metres
  std::optional<Eigen::Vector3d> position_sigma;
};

/// The text of a covariance.csv: `index1,index2,c00,c01,…,c05,c11,…,c55,sigma_x,sigma_y,sigma_z`,
/// the upper triangle row by row. Reads back exactly.
/// @throws std::invalid_argument when a number is not finite
[[nodiscard]] std::string format_covariances(const std::vector<CovarianceRow>& rows);
/// Its parts, for what is written piece by piece. @throws as format_covariances()
[[nodiscard]] std::string covariances_header();
[[nodiscard]] std::string covariance_line(const CovarianceRow& row);

/// Reads a covariance.csv as written by format_covariances().
/// @throws InputError naming file, line and cure: not readable, another header, a wrong number of
///         fields, not a finite number
[[nodiscard]] std::vector<CovarianceRow> read_covariances(const std::filesystem::path& path);

/// How sure a drive is of where it was: a row of a trajectory_*.csv.
struct PoseCovarianceRow {
  std::size_t index = 0;  ///< of the image
  double time_s = 0.0;    ///< Unix time [s]
  Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
  /// Of (θ, p) in the world: R ← exp([θ]×) R, p ← p + δp [rad², rad m, m²]
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  bool metric = false;       ///< the step to it is
  bool has_lengths = false;  ///< the drive is in metres, so that what concerns p means something
};

/// The text of a trajectory_camera.csv or trajectory_vehicle.csv:
/// `time,x,y,z,qw,qx,qy,qz,index,metric,c00,c01,…,c05,c11,…,c55`, the upper triangle row by row,
/// its entries with p empty without `has_lengths`. read_trajectory_file() reads its poses.
/// @throws std::invalid_argument when a number is not finite
[[nodiscard]] std::string format_pose_covariances(const std::vector<PoseCovarianceRow>& rows);
/// Its parts, for what is written piece by piece. @throws as format_pose_covariances()
[[nodiscard]] std::string pose_covariances_header();
[[nodiscard]] std::string pose_covariance_line(const PoseCovarianceRow& row);

/// The row of a body that sits so in the one of `row`, in the world that sits so in its world:
/// T_fixed T_world_body T_fixed⁻¹, as the vehicle's of its camera's.
[[nodiscard]] PoseCovarianceRow carried_to(const Eigen::Isometry3d& T_fixed,
                                           const PoseCovarianceRow& row);
/// The same where the two sit differently: T_world T_world_body T_body⁻¹.
[[nodiscard]] PoseCovarianceRow carried_to(const Eigen::Isometry3d& T_world,
                                           const Eigen::Isometry3d& T_body,
                                           const PoseCovarianceRow& row);

}  // namespace oneac
