#include "drive_record.h"

#include "oneac/frontend/step_metres.h"
#include "oneac/frontend/trajectory_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
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

void DriveRecord::take(Settled settled) {
  for (const SettledFrame& frame : settled.frames) {
    frames.at(frame.frame).T_first_cam = frame.T_first_cam;
  }
  std::move(settled.keyframes.begin(), settled.keyframes.end(), std::back_inserter(keyframes));
}

void DriveRecord::take(SettledTracks settled) {
  const auto& [sightings, of_points] = settled;
  tracks.sightings.insert(tracks.sightings.end(), sightings.begin(), sightings.end());
  tracks.of_points.insert(tracks.of_points.end(), of_points.begin(), of_points.end());
}

void DriveRecord::doubt_metres(double doubt, double max_uncertainty) {
  for (FrameResult& frame : frames) {
    if (frame.step) oneac::doubt_metres(*frame.step, doubt, max_uncertainty);
  }
  for (Keyframe& keyframe : keyframes) {
    keyframe.metric = keyframe.metric && doubt <= max_uncertainty;
  }
  common_length_sigma = std::hypot(common_length_sigma, doubt);
}

void DriveRecord::withdraw_metres() {
  for (FrameResult& frame : frames) {
    if (!frame.step) continue;
    oneac::withdraw_metres(*frame.step);
  }
  for (Keyframe& keyframe : keyframes) keyframe.metric = false;
}

Trajectory DriveRecord::keyframe_trajectory() const {
  Trajectory trajectory;
  for (const Keyframe& keyframe : keyframes) {
    // A map that begins anew begins at the last frame, which may have closed the map before.
    if (!trajectory.times.empty() && keyframe.time_s <= trajectory.times.back()) {
      trajectory.poses.back() = keyframe.T_first_cam;
      continue;
    }
    trajectory.times.push_back(keyframe.time_s);
    trajectory.poses.push_back(keyframe.T_first_cam);
  }
  return trajectory;
}

Trajectory DriveRecord::camera_trajectory() const {
  Trajectory trajectory;
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

Trajectory DriveRecord::vehicle_trajectory() const {
  const Eigen::Isometry3d T = mount();
  Trajectory trajectory;
  for (const FrameResult& frame : frames) {
    trajectory.times.push_back(frame.time_s);
    trajectory.poses.push_back(T * frame.T_first_cam * T.inverse());
  }
  return trajectory;
}

std::vector<RelativePoseRow> DriveRecord::relative_poses() const {
  std::vector<RelativePoseRow> rows;
  for (const FrameResult& frame : frames) {
    if (!frame.step) continue;
    rows.push_back(row_of(*frame.step, sigma_of_length(*frame.step)));
  }
  return rows;
}

std::vector<CovarianceRow> DriveRecord::covariances() const {
  const auto positions = position_covariances(frames, common_length_sigma, camera_belief.doubt);
  const bool scaled = has_scale();
  std::vector<CovarianceRow> rows;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!frames[i].step) continue;
    const StepResult& step = *frames[i].step;
    CovarianceRow row{step.index1, step.index2, step.covariance, std::nullopt};
    if (scaled) {
      row.position_sigma = Eigen::Vector3d(positions[i].diagonal().cwiseMax(0.0).cwiseSqrt());
    }
    rows.push_back(row);
  }
  return rows;
}

std::vector<PoseCovarianceRow> DriveRecord::camera_poses() const {
  const auto covariances = pose_covariances(frames, common_length_sigma, camera_belief.doubt);
  const bool scaled = has_scale();
  std::vector<PoseCovarianceRow> rows;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const FrameResult& frame = frames[i];
    rows.push_back({frame.index, frame.time_s, frame.T_first_cam, covariances[i],
                    frame.step && frame.step->metric, scaled});
  }
  return rows;
}

std::vector<PoseCovarianceRow> DriveRecord::vehicle_poses() const {
  const Eigen::Isometry3d T = mount();
  std::vector<PoseCovarianceRow> rows = camera_poses();
  for (PoseCovarianceRow& row : rows) row = carried_to(T, row);
  return rows;
}

std::vector<TimingRow> DriveRecord::timings() const {
  std::vector<TimingRow> rows;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!frames[i].step) continue;
    const StepResult& step = *frames[i].step;
    rows.push_back({step.index1, step.index2, decode_ms[i], step.features_ms, step.estimate_ms,
                    step.refine_ms});
  }
  return rows;
}

}  // namespace oneac::app
