#pragma once

#include "oneac/geometry/relative_pose.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace oneac {

/// One pair of processed frames: a row of relative_poses.csv.
struct RelativePoseRow {
  std::size_t index1 = 0;  ///< image of the selected camera, counted from 0 over the whole log
  std::size_t index2 = 0;
  double t1 = 0.0;      ///< Unix time of the first image [s]
  double t2 = 0.0;      ///< Unix time of the second image [s]
  RelativePose T_2_1;   ///< X2 = R X1 + t, camera optical frame
  bool metric = false;  ///< t in metres; otherwise of unit length, or zero
  int inliers = 0;
  int acs = 0;                         ///< affine correspondences found
  std::string status;                  ///< one word, e.g. "ok"
  std::optional<double> sigma_length;  ///< [m] 1σ of the length; empty where not metric
};

/// The row of a front end's step, of the fields that both have.
/// @param sigma_length  [m] 1σ of the step's length; empty where not metric
template <class Step>
[[nodiscard]] RelativePoseRow row_of(const Step& step, std::optional<double> sigma_length) {
  RelativePoseRow row;
  row.index1 = step.index1;
  row.index2 = step.index2;
  row.t1 = step.time1;
  row.t2 = step.time2;
  row.T_2_1 = step.pose;
  row.metric = step.metric;
  row.inliers = static_cast<int>(step.inliers);
  row.acs = static_cast<int>(step.acs);
  row.status = to_string(step.status);
  row.sigma_length = sigma_length;
  return row;
}

/// What one pair cost: a row of timings.csv, thread CPU time of each stage [ms].
struct TimingRow {
  std::size_t index1 = 0;
  std::size_t index2 = 0;
  double decode_ms = 0.0;
  double features_ms = 0.0;
  double estimate_ms = 0.0;
  double refine_ms = 0.0;
};

/// Reads a relative_poses.csv; columns are found by name, in any order, others are passed over. The
/// column `sigma_length` may be missing, as in files from before it.
/// @throws InputError naming file, line and cure: not readable, a column is missing, a row with
///         too few fields, not a finite number, not a unit quaternion, metric neither 0 nor 1,
///         a negative sigma_length
[[nodiscard]] std::vector<RelativePoseRow> read_relative_poses(const std::filesystem::path& path);

/// True when the first line of the file names the columns of a relative_poses.csv; false also when
/// it cannot be read.
[[nodiscard]] bool looks_like_relative_poses(const std::filesystem::path& path);

/// The text of a relative_poses.csv; poses and times read back exactly (rotations to rounding).
/// @throws std::invalid_argument when a number is not finite, a sigma_length is negative, or a
///         status has a comma or line break
[[nodiscard]] std::string format_relative_poses(const std::vector<RelativePoseRow>& rows);
/// Its parts, for what is written piece by piece. @throws as format_relative_poses()
[[nodiscard]] std::string relative_poses_header();
[[nodiscard]] std::string relative_pose_line(const RelativePoseRow& row);

/// The text of a timings.csv, three decimals.
/// @throws std::invalid_argument when a number is not finite
[[nodiscard]] std::string format_timings(const std::vector<TimingRow>& rows);
/// Its parts. @throws as format_timings()
[[nodiscard]] std::string timings_header();
[[nodiscard]] std::string timing_line(const TimingRow& row);

}  // namespace oneac
