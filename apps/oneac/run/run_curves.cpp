#include "run_curves.h"

#include "reference_track.h"

#include "oneac/calibration/intrinsics_belief.h"
#include "oneac/evaluation/pair_errors.h"
#include "oneac/geometry/angles.h"
#include "oneac/report/thinned_series.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace oneac::app {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();  // leaves a gap
// [m] over which the scale is compared: far more than the centimetres that a reference is good to.
constexpr double kScaleStretch = 20.0;
constexpr double kStanding = 0.5;  // [m/s] below which the course of a GPS is noise

/// Seconds since the first frame.
double seconds(const DriveRecord& record, double time_s) {
  return time_s - record.frames.front().time_s;
}

double yaw_of(const Eigen::Matrix3d& R) {
  return std::atan2(R(1, 0), R(0, 0));
}

/// One value per step over the time of its second image.
template <class Value>
PlotSeries per_step(const DriveRecord& record, const std::string& label, Value&& value) {
  PlotSeries series{label, {}, {}, Pen::kLine};
  ThinnedSeries points(series, record.frames.size());
  const double start = record.frames.front().time_s;
  std::size_t i = 0;
  for (const FrameResult& frame : record.frames) {
    if (i++ == 0) continue;
    points.add(frame.time_s - start, frame.step ? value(i - 1, *frame.step) : kNone);
  }
  points.flush();
  return series;
}

/// One value per step between frames that both have a reference pose.
template <class Value>
void add_reference(const DriveRecord& record, const ReferenceTrack& track, Plot& plot,
                   Value&& value) {
  if (track.poses.empty()) return;
  plot.series.push_back(per_step(record, "reference", [&](std::size_t i, const StepResult& step) {
    const auto& before = track.poses[i - 1];
    const auto& now = track.poses[i];
    return before && now ? value(*before, *now) / (step.time2 - step.time1) : kNone;
  }));
}

bool is_during(const DriveRecord& record, double time_s) {
  return time_s >= record.frames.front().time_s && time_s <= record.frames.back().time_s;
}

Plot speed_plot(const DriveRecord& record, const ReferenceTrack& track) {
  Plot plot{"Speed", "time [s]", record.has_scale() ? "m/s" : "units/s", {}, true};
  plot.series.push_back(per_step(record, "estimate", [](std::size_t, const StepResult& step) {
    return step.length / (step.time2 - step.time1);
  }));
  if (!record.has_scale()) return plot;  // a reference in metres would squeeze it
  add_reference(record, track, plot, [](const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
    return (b.translation() - a.translation()).norm();
  });
  PlotSeries gps{"GPS", {}, {}, Pen::kDots};
  for (const GpsFix& fix : record.source.reference.gps) {
    if (!fix.speed || !is_during(record, fix.time_s)) continue;
    gps.x.push_back(seconds(record, fix.time_s));
    gps.y.push_back(*fix.speed);
  }
  if (!gps.x.empty()) plot.series.push_back(gps);
  return plot;
}

/// Turn between fixes over the time between them, where both drive.
PlotSeries course_rate(const DriveRecord& record) {
  PlotSeries series{"GPS course", {}, {}, Pen::kDots};
  const GpsFix* before = nullptr;
  for (const GpsFix& fix : record.source.reference.gps) {
    const bool drives = fix.course && fix.speed && *fix.speed >= kStanding;
    if (drives && before != nullptr && fix.time_s > before->time_s) {
      const double middle = 0.5 * (before->time_s + fix.time_s);
      const double turn = -std::remainder(*fix.course - *before->course, 2.0 * M_PI);
      if (is_during(record, middle)) {
        series.x.push_back(seconds(record, middle));
        series.y.push_back(turn / (fix.time_s - before->time_s) / kDegree);
      }
    }
    before = drives ? &fix : nullptr;
  }
  return series;
}

Plot yaw_rate_plot(const DriveRecord& record, const ReferenceTrack& track) {
  Plot plot{"Yaw rate (left positive)", "time [s]", "deg/s", {}, false};
  const auto pose = [&](std::size_t i) {
    return record.vehicle_pose(record.frames[i].T_first_cam);
  };
  plot.series.push_back(per_step(record, "estimate", [&](std::size_t i, const StepResult& step) {
    const Eigen::Isometry3d before = pose(i - 1), now = pose(i);
    return yaw_of(before.linear().transpose() * now.linear()) / (step.time2 - step.time1) / kDegree;
  }));
  const Eigen::Matrix3d R = record.mount().linear();
  add_reference(record, track, plot, [&](const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
    return yaw_of(R * a.linear().transpose() * b.linear() * R.transpose()) / kDegree;
  });
  PlotSeries gps = course_rate(record);
  if (!gps.x.empty()) plot.series.push_back(std::move(gps));
  return plot;
}

/// Path of the estimate over that of the reference − 1 over the last kScaleStretch metres.
PlotSeries scale_error(const DriveRecord& record, const ReferenceTrack& track) {
  PlotSeries series{"error over the last 20 m", {}, {}, Pen::kLine};
  std::vector<double> estimated, truth;
  std::size_t begin = 0;
  const auto restart = [&] { estimated = truth = {0.0}, begin = 0; };
  restart();
  ThinnedSeries points(series, record.frames.size());
  for (std::size_t i = 1; i < record.frames.size(); ++i) {
    if (!track.poses[i - 1] || !track.poses[i]) {
      restart();
      continue;
    }
    const auto step = [&](const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
      return (b.translation() - a.translation()).norm();
    };
    const FrameResult before = record.frames[i - 1], now = record.frames[i];
    estimated.push_back(estimated.back() + step(before.T_first_cam, now.T_first_cam));
    truth.push_back(truth.back() + step(*track.poses[i - 1], *track.poses[i]));
    while (truth.back() - truth[begin + 1] >= kScaleStretch) ++begin;
    const double length = truth.back() - truth[begin];
    if (length < kScaleStretch) continue;
    points.add(seconds(record, now.time_s),
               100.0 * ((estimated.back() - estimated[begin]) / length - 1.0));
  }
  points.flush();
  return series;
}

Plot scale_plot(const DriveRecord& record, const ReferenceTrack& track) {
  Plot plot{"Scale", "time [s]", "%", {}, false};
  plot.series.push_back(
      per_step(record, "1σ of a metric length", [](std::size_t, const StepResult& step) {
        const bool drives = step.metric && step.length > kSmallestTrueStep;  // no share of nothing
        return drives && step.length_sigma > 0.0 ? 100.0 * step.length_sigma : kNone;
      }));
  if (!track.poses.empty() && record.has_scale()) {
    plot.series.push_back(scale_error(record, track));
  }
  return plot;
}

Plot tilt_plot(const DriveRecord& record) {
  Plot plot{"Tilt of the camera, as believed", "time [s]", "deg", {}, false};
  const auto add = [&](const char* label, auto&& angle) {
    PlotSeries series{label, {}, {}, Pen::kLine};
    ThinnedSeries points(series, record.frames.size());
    const double start = record.frames.front().time_s;
    for (const FrameResult& frame : record.frames) {
      points.add(frame.time_s - start, angle(frame) / kDegree);
    }
    points.flush();
    plot.series.push_back(std::move(series));
  };
  add("axis above the horizon", [](const FrameResult& f) { return f.tilt.tilt.pitch_up; });
  add("leaning right", [](const FrameResult& f) { return f.tilt.tilt.roll_right; });
  add("pitch of the springs", [](const FrameResult& f) { return f.suspension.angle; });
  return plot;
}

Plot counts_plot(const DriveRecord& record) {
  Plot plot{"Affine correspondences", "time [s]", "count", {}, true};
  const auto add = [&](const char* label, std::size_t StepResult::*field) {
    plot.series.push_back(per_step(record, label, [=](std::size_t, const StepResult& step) {
      return static_cast<double>(step.*field);
    }));
  };
  add("inliers", &StepResult::inliers);
  add("all", &StepResult::acs);
  add("on the road", &StepResult::ground_acs);
  add("landmarks", &StepResult::landmarks);
  return plot;
}

/// Errors of the pairs over the time of their second image.
std::vector<Plot> error_plots(const DriveRecord& record, const RunEvaluation& evaluation) {
  if (!evaluation.against_poses || evaluation.against_poses->pairs.empty()) return {};
  Plot rotation{"Rotation error of a pair", "time [s]", "deg", {{"estimate", {}, {}}}, true};
  Plot direction{"Direction error of a pair", "time [s]", "deg", {{"estimate", {}, {}}}, true};
  const auto& pairs = evaluation.against_poses->pairs;
  ThinnedSeries of_rotation(rotation.series[0], pairs.size());
  ThinnedSeries of_direction(direction.series[0], pairs.size());
  const double start = record.frames.front().time_s;
  std::size_t i = 0;
  for (const FrameResult& frame : record.frames) {  // pairs are in the order of the frames
    if (!frame.step || i == pairs.size() || pairs[i].index2 != frame.step->index2) continue;
    const double time = frame.time_s - start;
    of_rotation.add(time, pairs[i].rotation / kDegree);
    of_direction.add(time, pairs[i].direction ? *pairs[i].direction / kDegree : kNone);
    ++i;
  }
  of_rotation.flush();
  of_direction.flush();
  return {rotation, direction};
}

/// A number with its 1σ, as bend after bend tells it.
template <class Value>
void add_learned(const DriveRecord& record, const std::string& label, Plot& plot, Value&& value) {
  PlotSeries best{label, {}, {}, Pen::kMarkers}, low{"−1σ", {}, {}}, high{"+1σ", {}, {}};
  for (const CameraMoment& moment : record.camera_belief.history) {
    const double time = moment.time_s - record.frames.front().time_s;
    for (PlotSeries* series : {&best, &low, &high}) series->x.push_back(time);
    const auto [mean, sigma] = value(moment);
    best.y.push_back(mean);
    low.y.push_back(mean - sigma);
    high.y.push_back(mean + sigma);
  }
  for (PlotSeries* series : {&best, &low, &high}) plot.series.push_back(std::move(*series));
}

/// What bends tell of the camera; all but its focal length takes two of them.
std::vector<Plot> camera_plots(const DriveRecord& record) {
  const CameraBelief& belief = record.camera_belief;
  if (belief.history.empty()) return {};
  std::vector<Plot> plots{{"Focal length by the bends", "time [s]", "px", {}}};
  add_learned(record, "by the bends", plots[0], [](const CameraMoment& moment) {
    return std::pair(moment.focal_px, moment.focal_sigma * moment.focal_px);
  });
  if (!belief.knows_raw || belief.bends < IntrinsicsBelief::kFewestWindows) return plots;
  plots.push_back({"Principal point by the bends, off the given one", "time [s]", "px", {}});
  const auto add_centre = [&](const char* label, double PinholeCamera::*which, Intrinsic unknown) {
    add_learned(record, label, plots[1], [&, which, unknown](const CameraMoment& moment) {
      return std::pair(moment.raw_learned.*which - record.raw_camera.*which,
                       moment.sigma[unknown] * record.raw_camera.focal_px());
    });
  };
  add_centre("cx", &PinholeCamera::cx, kCentreX);
  add_centre("cy", &PinholeCamera::cy, kCentreY);
  plots.push_back({"Distortion by the bends", "time [s]", "", {}});
  add_learned(record, "k1", plots[2], [](const CameraMoment& moment) {
    return std::pair(moment.raw_learned.distortion[0], moment.sigma[kK1]);
  });
  add_learned(record, "k2", plots[2], [](const CameraMoment& moment) {
    return std::pair(moment.raw_learned.distortion[1], moment.sigma[kK2]);
  });
  return plots;
}

}  // namespace

std::vector<Plot> plots_of(const DriveRecord& record, const RunEvaluation& evaluation) {
  if (record.frames.empty()) return {};
  const ReferenceTrack track = reference_track(record, evaluation);
  std::vector<Plot> plots = {speed_plot(record, track), yaw_rate_plot(record, track),
                             scale_plot(record, track), tilt_plot(record)};
  plots.push_back(counts_plot(record));
  for (Plot& plot : camera_plots(record)) plots.push_back(std::move(plot));
  for (Plot& plot : error_plots(record, evaluation)) plots.push_back(std::move(plot));
  return plots;
}

Plot timing_plot_of(const DriveRecord& record) {
  Plot plot{"CPU time of the stages", "time [s]", "ms", {}, true};
  if (record.frames.empty()) return plot;
  const auto add = [&](const char* label, auto&& value) {
    plot.series.push_back(per_step(record, label, value));
  };
  add("decode", [&](std::size_t i, const StepResult&) { return record.decode_ms[i]; });
  add("features", [](std::size_t, const StepResult& step) { return step.features_ms; });
  add("estimate", [](std::size_t, const StepResult& step) { return step.estimate_ms; });
  add("refine", [](std::size_t, const StepResult& step) { return step.refine_ms; });
  return plot;
}

}  // namespace oneac::app
