#pragma once

#include <Eigen/Core>

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

/// Reads a covariance.csv as written by format_covariances().
/// @throws InputError naming file, line and cure: not readable, another header, a wrong number of
///         fields, not a finite number
[[nodiscard]] std::vector<CovarianceRow> read_covariances(const std::filesystem::path& path);

}  // namespace oneac
