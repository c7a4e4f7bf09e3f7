#pragma once

#include <Eigen/Geometry>

#include <filesystem>
#include <string>
#include <vector>

namespace oneac {

/// Poses T_world_body, one per frame: where the body is and how it is turned, in the world [m].
struct Trajectory {
  std::vector<double> times;  ///< Unix time [s], strictly increasing; empty or as many as poses
  std::vector<Eigen::Isometry3d> poses;

  /// A time per pose, else none.
  [[nodiscard]] bool has_times() const { return !times.empty(); }
  /// @throws std::invalid_argument naming the row: times that do not fit the poses or do not
  ///         increase, numbers that are not finite
  void validate() const;
};

/// Reads a KITTI file: the upper three rows of T_world_body per line, row by row, 12 numbers.
///
/// Blank lines and lines that start with # are passed over; rotations are made orthonormal.
/// @throws InputError naming file, line and cure: not readable, no pose, wrong number of columns,
///         not a finite number, not a rotation
[[nodiscard]] Trajectory read_kitti(const std::filesystem::path& path);

/// Reads a TUM file: `time x y z qx qy qz qw` per line; otherwise as read_kitti.
/// @throws InputError as read_kitti, and when the times do not increase
[[nodiscard]] Trajectory read_tum(const std::filesystem::path& path);

/// Reads either: `.kitti` and `.tum` as they are called, anything else by the number of columns of
/// its first pose (12 or 8). @throws InputError as the above
[[nodiscard]] Trajectory read_trajectory(const std::filesystem::path& path);

/// The text of a KITTI file; numbers read back as the same doubles, whatever the locale.
/// @throws std::invalid_argument as validate()
[[nodiscard]] std::string format_kitti(const Trajectory& trajectory);

/// The text of a TUM file, qw ≥ 0, times with at least six decimals.
/// @throws std::invalid_argument as validate(), and when there are no times
[[nodiscard]] std::string format_tum(const Trajectory& trajectory);

}  // namespace oneac
