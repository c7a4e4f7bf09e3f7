#include "drive_record.h"

#include "oneac/frontend/step_metres.h"
#include "oneac/frontend/trajectory_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace oneac::app {

double DriveRecord::car_mask_share() const {
  if (car_mask.empty()) return 0.0;
  std::ptrdiff_t dark = 0;
  for (int v = 0; v < car_mask.height(); ++v) {
    dark += std::count(car_mask.row(v), car_mask.row(v) + car_mask.width(), 0);
  }
  return static_cast<double>(dark) / (car_mask.width() * car_mask.height());
}

bool DriveRecord::has_scale() const {
  // A standing step has zero metres without any scale.
  return std::any_of(frames.begin(), frames.end(), [](const FrameResult& frame) {
    return frame.step && frame.step->metric && frame.step->status == StepStatus::kOk;
  });
}

void DriveRecord::add(FrameResult frame, double decode) {
  const Settled settled = std::exchange(frame.settled, {});
  if (frame.step && !frame.step->fault.empty() && faulty.count++ == 0) {
    faulty.first = "images " + std::to_string(frame.step->index1) + "-" +
                   std::to_string(frame.step->index2) + ": " + frame.step->fault;
  }
  frames.push_back(frame);
  decode_ms.push_back(decode);
  take(settled);
}

void DriveRecord::take(const Settled& settled) {
  for (const SettledFrame& final : settled.frames) {
    FrameResult frame = frames.at(final.frame);
    frame.T_first_cam = final.T_first_cam;
    frames.replace(final.frame, frame);
  }
  for (const Keyframe& keyframe : settled.keyframes) keyframes.push_back(keyframe);
}

void DriveRecord::take(const SettledTracks& settled) {
  const auto& [sightings, of_points] = settled;
  tracks.sightings.insert(tracks.sightings.end(), sightings.begin(), sightings.end());
  tracks.of_points.insert(tracks.of_points.end(), of_points.begin(), of_points.end());
}

void DriveRecord::doubt_metres(double doubt, double max_uncertainty) {
  frames.change_all([&](FrameResult& frame) {
    if (frame.step) oneac::doubt_metres(*frame.step, doubt, max_uncertainty);
  });
  keyframes.keep_metric(doubt <= max_uncertainty);
  common_length_sigma = std::hypot(common_length_sigma, doubt);
}

void DriveRecord::withdraw_metres() {
  frames.change_all([](FrameResult& frame) {
    if (frame.step) oneac::withdraw_metres(*frame.step);
  });
  keyframes.keep_metric(false);
}

Trajectory DriveRecord::camera_trajectory() const {
  Trajectory trajectory;
  trajectory.times.reserve(frames.size());
  trajectory.poses.reserve(frames.size());
  for (const FrameResult& frame : frames) {
    trajectory.times.push_back(frame.time_s);
    trajectory.poses.push_back(frame.T_first_cam);
  }
  return trajectory;
}

Eigen::Isometry3d DriveRecord::mount() const {
  // The log's heading of the camera with the pitch and roll that the drive confirmed.
  const Tilt log_tilt = tilt_from_mounting(T_vehicle_cam.linear());
  const Eigen::Matrix3d R_vehicle_level =
      T_vehicle_cam.linear() * levelling_rotation(log_tilt).transpose();
  Eigen::Isometry3d T = T_vehicle_cam;
  T.linear() = R_vehicle_level * levelling_rotation(tilt);
  return T;
}

Eigen::Isometry3d DriveRecord::vehicle_pose(const Eigen::Isometry3d& T_first_cam) const {
  const Eigen::Isometry3d T = mount();
  return T * T_first_cam * T.inverse();
}

Trajectory DriveRecord::vehicle_trajectory() const {
  Trajectory trajectory = camera_trajectory();
  const Eigen::Isometry3d T = mount();
  for (Eigen::Isometry3d& pose : trajectory.poses) {
    const Eigen::Isometry3d T_first_cam = pose;
    pose = T * T_first_cam * T.inverse();
  }
  return trajectory;
}

std::vector<RelativePoseRow> DriveRecord::relative_poses() const {
  std::vector<RelativePoseRow> rows;
  each_relative_pose([&](const RelativePoseRow& row) { rows.push_back(row); });
  return rows;
}

void DriveRecord::each_relative_pose(
    const std::function<void(const RelativePoseRow&)>& visit) const {
  for (const FrameResult& frame : frames) {
    if (!frame.step) continue;
    visit(row_of(*frame.step, sigma_of_length(*frame.step)));
  }
}

void DriveRecord::each_covariance(const std::function<void(const CovarianceRow&)>& visit) const {
  PoseUncertainty chain(common_length_sigma, camera_belief.doubt);
  const bool scaled = has_scale();
  for (const FrameResult& frame : frames) {
    const Eigen::Matrix3d position = chain.add(frame).bottomRightCorner<3, 3>();
    if (!frame.step) continue;
    const StepResult& step = *frame.step;
    CovarianceRow row{step.index1, step.index2, step.covariance, std::nullopt};
    if (scaled) row.position_sigma = Eigen::Vector3d(position.diagonal().cwiseMax(0.0).cwiseSqrt());
    visit(row);
  }
}

void DriveRecord::each_camera_pose(
    const std::function<void(const PoseCovarianceRow&)>& visit) const {
  PoseUncertainty chain(common_length_sigma, camera_belief.doubt);
  const bool scaled = has_scale();
  for (const FrameResult& frame : frames) {
    visit({frame.index, frame.time_s, frame.T_first_cam, chain.add(frame),
           frame.step && frame.step->metric, scaled});
  }
}

void DriveRecord::each_vehicle_pose(
    const std::function<void(const PoseCovarianceRow&)>& visit) const {
  const Eigen::Isometry3d T = mount();
  each_camera_pose([&](const PoseCovarianceRow& row) { visit(carried_to(T, row)); });
}

void DriveRecord::each_timing(const std::function<void(const TimingRow&)>& visit) const {
  std::size_t i = 0;
  for (const FrameResult& frame : frames) {
    const double decode = decode_ms[i++];
    if (!frame.step) continue;
    const StepResult& step = *frame.step;
    visit({step.index1, step.index2, decode, step.features_ms, step.estimate_ms, step.refine_ms});
  }
}

}  // namespace oneac::app
