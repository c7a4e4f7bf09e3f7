#pragma once

#include "drive_record.h"
#include "run_summary.h"

#include "oneac/report/plot.h"

#include <vector>

namespace oneac::app {

/// The rigid motion, and with `scaled` the scale, that brings points of the plane onto others.
struct PlaneAlignment {
  double scale = 1.0;
  Eigen::Matrix2d R = Eigen::Matrix2d::Identity();
  Eigen::Vector2d t = Eigen::Vector2d::Zero();

  [[nodiscard]] Eigen::Vector2d operator*(const Eigen::Vector2d& x) const {
    return scale * (R * x) + t;
  }
};

/// Least squares over x[i] → y[i]; points without spread give no rotation and no scale. A straight
/// drive determines it too, which a fit in space would leave free to roll.
/// @pre as many x as y
[[nodiscard]] PlaneAlignment align_in_plane(const std::vector<Eigen::Vector2d>& x,
                                            const std::vector<Eigen::Vector2d>& y, bool scaled);

/// The way seen from above, first heading up; reference poses and GPS positions laid over it by
/// align_in_plane. A way without scale takes that of the reference.
[[nodiscard]] Plot plan_of(const DriveRecord& record, const RunEvaluation& evaluation);

/// The way before and after it was closed, a line per loop, the reference laid over the latter.
[[nodiscard]] Plot plan_of_loops(const DriveRecord& record, const RunEvaluation& evaluation,
                                 const ClosedDrive& closed);

/// Speed, yaw rate, scale, tilt, correspondences, and pair errors when there is a reference.
[[nodiscard]] std::vector<Plot> plots_of(const DriveRecord& record,
                                         const RunEvaluation& evaluation);

/// CPU time of the stages: the plot that depends on the clock.
[[nodiscard]] Plot timing_plot_of(const DriveRecord& record);

}  // namespace oneac::app
