#pragma once

#include "oneac/comparison/pair_record.h"
#include "oneac/evaluation/trajectory_io.h"
#include "oneac/rawlog/vehicle_reference.h"

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace oneac {

/// An image of a pair as a reference finds it.
struct ImageMoment {
  std::size_t index = 0;
  double time_s = 0.0;
};

/// What the true motion between two images was, as far as anything says so.
class PairReference {
 public:
  /// From poses of the camera, by time when they have times, by index otherwise.
  PairReference(Trajectory poses, const std::vector<ImageMoment>& images);
  /// From the log's GPS: the change of course about the vertical, no translation.
  PairReference(VehicleReference vehicle, const Eigen::Matrix3d& R_level_cam);

  /// T_2_1 [m] of the camera; t = 0 when only the turn is known.
  [[nodiscard]] std::optional<RelativePose> motion(const ImageMoment& first,
                                                   const ImageMoment& second) const;

 private:
  [[nodiscard]] const Eigen::Isometry3d* pose(const ImageMoment& image) const;

  std::optional<Trajectory> poses_;
  double tolerance_ = 0.0;
  VehicleReference vehicle_;
  Eigen::Matrix3d R_level_cam_ = Eigen::Matrix3d::Identity();
};

/// How good a GPS is as a reference of turns.
struct GpsQuality {
  double course_sigma = 0.0;   ///< [rad] 1σ noise of a course
  double heading_sigma = 0.0;  ///< [rad] 1σ of the turn between two images `spacing` apart
  double against_gyro = 0.0;   ///< [rad] root mean square over pairs; 0 without a gyroscope
  std::size_t courses = 0;     ///< that the noise was estimated from
};

/// Noise of the courses, from the residual of a parabola through five of them at a time, and what
/// it makes of the turn between two images [s] apart. Empty with fewer than five courses in a row.
[[nodiscard]] std::optional<GpsQuality> gps_quality(const VehicleReference& vehicle,
                                                    double spacing_s);

/// Root mean square of GPS turn − gyroscope turn over the pairs [rad]; empty without a gyroscope.
/// The gyroscope's bias is removed as the median of the differences; its Z axis is taken upwards.
[[nodiscard]] std::optional<double> gps_against_gyro(const VehicleReference& vehicle,
                                                     const std::vector<ImageMoment>& images);

}  // namespace oneac
