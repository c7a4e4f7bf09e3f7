#include "reference_track.h"
#include "run_curves.h"

#include "oneac/report/thinned_series.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace oneac::app {
namespace {

using Points = std::vector<Eigen::Vector2d>;

Eigen::Vector2d mean_of(const Points& points) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& point : points) sum += point;
  return sum / static_cast<double>(std::max<std::size_t>(points.size(), 1));
}

/// A point in the first camera's frame, seen from above: right of the vehicle, ahead of it.
Eigen::Vector2d from_above(const Eigen::Matrix3d& R_vehicle_cam, const Eigen::Vector3d& point) {
  const Eigen::Vector3d p = R_vehicle_cam * point;
  return {-p.y(), p.x()};
}

/// What is laid over the way: points of the reference, and the way's at the same moments.
struct Laid {
  const char* label;
  Pen pen;
  Points path;
  Points estimate;
};

Laid laid_poses(const DriveRecord& record, const RunEvaluation& evaluation, const Points& way) {
  Laid laid{"reference", Pen::kLine, {}, {}};
  const ReferenceTrack track = reference_track(record, evaluation);
  const Eigen::Matrix3d R = record.mount().linear();
  std::optional<Eigen::Isometry3d> first;
  for (std::size_t i = 0; i < track.poses.size(); ++i) {
    if (!track.poses[i]) continue;
    if (!first) first = track.poses[i];
    laid.path.push_back(from_above(R, (first->inverse() * *track.poses[i]).translation()));
    laid.estimate.push_back(way[i]);
  }
  return laid;
}

Laid laid_gps(const DriveRecord& record, const Points& way) {
  Laid laid{"GPS", Pen::kDots, {}, {}};
  std::vector<double> times;
  for (const FrameResult& frame : record.frames) times.push_back(frame.time_s);
  for (const GpsFix& fix : record.source.reference.gps) {
    if (!fix.position_enu) continue;
    const auto after = std::upper_bound(times.begin(), times.end(), fix.time_s);
    if (after == times.begin() || after == times.end()) continue;
    const auto i = static_cast<std::size_t>(after - times.begin());
    const double share = (fix.time_s - times[i - 1]) / (times[i] - times[i - 1]);
    laid.path.push_back(fix.position_enu->head<2>());
    laid.estimate.push_back(way[i - 1] + share * (way[i] - way[i - 1]));
  }
  return laid;
}

void scale(Points& points, double factor) {
  for (Eigen::Vector2d& point : points) point *= factor;
}

PlotSeries series_of(const char* label, Pen pen, const Points& points) {
  PlotSeries series{label, {}, {}, pen};
  const std::size_t stride = plan_stride(points.size());
  const auto add = [&](const Eigen::Vector2d& point) {
    series.x.push_back(point.x());
    series.y.push_back(point.y());
  };
  for (std::size_t i = 0; i < points.size(); i += stride) add(points[i]);
  if (stride > 1) add(points.back());
  return series;
}

}  // namespace

PlaneAlignment align_in_plane(const Points& x, const Points& y, bool scaled) {
  const Eigen::Vector2d centre_x = mean_of(x), centre_y = mean_of(y);
  double dot = 0.0, cross = 0.0, spread = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Eigen::Vector2d a = x[i] - centre_x, b = y[i] - centre_y;
    dot += a.dot(b);
    cross += a.x() * b.y() - a.y() * b.x();
    spread += a.squaredNorm();
  }
  PlaneAlignment result;
  const double size = std::hypot(dot, cross);
  if (size > 0.0) {
    result.R << dot / size, -cross / size, cross / size, dot / size;
    if (scaled) result.scale = size / spread;
  }
  result.t = centre_y - result.scale * (result.R * centre_x);
  return result;
}

Plot plan_of(const DriveRecord& record, const RunEvaluation& evaluation) {
  Plot plan{"Seen from above, first heading up", "m", "", {}, false, Axes::kPlan};
  const Eigen::Matrix3d R = record.mount().linear();
  Points way, keyframes;
  for (const FrameResult& frame : record.frames) {
    way.push_back(from_above(R, frame.T_first_cam.translation()));
  }
  for (std::size_t i = 0; i < record.keyframes.size(); ++i) {
    keyframes.push_back(from_above(R, record.keyframes[i].T_first_cam.translation()));
  }
  std::vector<Laid> all = {laid_poses(record, evaluation, way), laid_gps(record, way)};
  const auto used =
      std::find_if(all.begin(), all.end(), [](const Laid& laid) { return laid.path.size() > 1; });
  double factor = 1.0;
  if (!record.has_scale() && used == all.end()) plan.x_label = "units";
  if (!record.has_scale() && used != all.end()) {
    factor = align_in_plane(used->estimate, used->path, true).scale;
  }
  scale(way, factor);
  scale(keyframes, factor);
  plan.series = {series_of("estimate", Pen::kLine, way)};
  for (Laid& laid : all) {
    if (laid.path.empty()) continue;
    scale(laid.estimate, factor);
    const PlaneAlignment onto = align_in_plane(laid.path, laid.estimate, false);
    for (Eigen::Vector2d& point : laid.path) point = onto * point;
    plan.series.push_back(series_of(laid.label, laid.pen, laid.path));
  }
  if (!keyframes.empty()) plan.series.push_back(series_of("keyframes", Pen::kRings, keyframes));
  return plan;
}

Plot plan_of_loops(const DriveRecord& record, const RunEvaluation& evaluation,
                   const ClosedDrive& closed) {
  Plot plan{"Before and after, first heading up", "m", "", {}, false, Axes::kPlan};
  const Eigen::Matrix3d R = record.mount().linear();
  // Both begin at one place, wherever other logs have put it.
  const Eigen::Isometry3d T_start =
      closed.frames.front() * record.frames.front().T_first_cam.inverse();
  Points before, after;
  for (std::size_t i = 0; i < record.frames.size(); ++i) {
    before.push_back(from_above(R, T_start * record.frames[i].T_first_cam.translation()));
    after.push_back(from_above(R, closed.frames[i].translation()));
  }
  plan.series = {series_of("after", Pen::kLine, after), series_of("before", Pen::kLine, before)};
  PlotSeries loops{"loops", {}, {}, Pen::kLine};
  for (const LoopConstraint& loop : closed.graph.loops) {
    for (const std::size_t end : {loop.first, loop.second}) {
      const Eigen::Vector2d p =
          from_above(R, T_start * record.keyframes[end].T_first_cam.translation());
      loops.x.push_back(p.x());
      loops.y.push_back(p.y());
    }
    loops.x.push_back(std::numeric_limits<double>::quiet_NaN());
    loops.y.push_back(std::numeric_limits<double>::quiet_NaN());
  }
  plan.series.push_back(loops);
  Laid laid = laid_poses(record, evaluation, after);
  if (laid.path.empty()) return plan;
  const PlaneAlignment onto = align_in_plane(laid.path, laid.estimate, false);
  for (Eigen::Vector2d& point : laid.path) point = onto * point;
  plan.series.push_back(series_of(laid.label, laid.pen, laid.path));
  return plan;
}

}  // namespace oneac::app
