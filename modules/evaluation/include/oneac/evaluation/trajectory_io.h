#pragma once

#include <Eigen/Geometry>

#include <filesystem>
#include <optional>
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

/// The rotation nearest to a matrix that is one but for what rounding to four digits does; empty
/// for one that stretches, shears or mirrors.
[[nodiscard]] std::optional<Eigen::Matrix3d> nearest_rotation(const Eigen::Matrix3d& M);

/// Reads a KITTI file: the upper three rows of T_world_body per line, row by row, 12 numbers.
///
/// Blank lines and lines that start with # are passed over; rotations are made orthonormal.
/// @throws InputError naming file, line and cure: not readable, no pose, wrong number of columns,
///         not a finite number, not a rotation
[[nodiscard]] Trajectory read_kitti(const std::filesystem::path& path);

/// Reads a TUM file: `time x y z qx qy qz qw` per line; otherwise as read_kitti.
/// @throws InputError as read_kitti, and when the times do not increase
[[nodiscard]] Trajectory read_tum(const std::filesystem::path& path);

/// A trajectory as people have it, and what was made of it.
struct TrajectoryFile {
  Trajectory trajectory;
  std::vector<std::string> notes;  ///< unit, order or stamps that were put right, one line each
};

/// Reads a trajectory by the columns of its first pose: KITTI (12), TUM (8), 4×4 matrices (16, or
/// four lines of 4), either matrix behind a time (13, 17), EuRoC (8 and more behind commas: time,
/// position, qw qx qy qz). Times may be in s, ms, µs or ns, since 1970 or since a start; rows out
/// of order are sorted, of several with one time the first is taken.
/// @throws InputError as read_kitti
[[nodiscard]] TrajectoryFile read_trajectory_file(const std::filesystem::path& path);

/// The same without the notes; `.kitti` as read_kitti.
[[nodiscard]] Trajectory read_trajectory(const std::filesystem::path& path);

/// The text of a KITTI file; numbers read back as the same doubles, whatever the locale.
/// @throws std::invalid_argument as validate()
[[nodiscard]] std::string format_kitti(const Trajectory& trajectory);

/// The text of a TUM file, qw ≥ 0, times with at least six decimals.
/// @throws std::invalid_argument as validate(), and when there are no times
[[nodiscard]] std::string format_tum(const Trajectory& trajectory);

/// The line of one pose, as in format_kitti() and format_tum(), for what is written piece by piece.
/// @throws std::invalid_argument when a number is not finite
[[nodiscard]] std::string kitti_line(const Eigen::Isometry3d& T_world_body);
[[nodiscard]] std::string tum_line(double time_s, const Eigen::Isometry3d& T_world_body);

}  // namespace oneac
