#include "closed_covariances.h"

#include "oneac/geometry/relative_pose.h"

#include <algorithm>
#include <cstddef>

namespace oneac::app {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Of (θ, p), from a keyframe to a frame that is `way` ahead of it.
Matrix6 carried_along(const Matrix6& covariance, const Eigen::Vector3d& way) {
  Matrix6 J = Matrix6::Identity();
  J.bottomLeftCorner<3, 3>() = -cross_matrix(way);
  return J * covariance * J.transpose();
}

/// The keyframes around a frame, and how far it is from the first to the second.
struct Between {
  std::size_t first, second;
  double share;
};

Between keyframes_around(const KeyframeStore& keyframes, std::size_t frame, double time_s) {
  const std::size_t second = keyframes.first_behind(frame);
  if (second == 0) return {0, 0, 0.0};
  if (second == keyframes.size()) return {second - 1, second - 1, 0.0};
  const double begin = keyframes[second - 1].time_s, end = keyframes[second].time_s;
  const double share = end > begin ? (time_s - begin) / (end - begin) : 0.0;
  return {second - 1, second, std::clamp(share, 0.0, 1.0)};
}

}  // namespace

std::vector<PoseCovarianceRow> closed_camera_poses(const DriveRecord& record,
                                                   const ClosedDrive& closed) {
  std::vector<PoseCovarianceRow> rows;
  record.each_camera_pose([&](const PoseCovarianceRow& row) { rows.push_back(row); });
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].T_world_body = closed.frames[i];
    if (closed.covariances.empty()) continue;
    const Between around = keyframes_around(record.keyframes, i, rows[i].time_s);
    const auto by = [&](std::size_t keyframe) {
      return carried_along(
          closed.covariances[keyframe],
          closed.frames[i].translation() - closed.graph.T_first_cam[keyframe].translation());
    };
    const Matrix6 all = (1.0 - around.share) * by(around.first) + around.share * by(around.second);
    rows[i].covariance = 0.5 * (all + all.transpose());
  }
  return rows;
}

std::vector<PoseCovarianceRow> closed_vehicle_poses(const DriveRecord& record,
                                                    const ClosedDrive& closed) {
  std::vector<PoseCovarianceRow> rows = closed_camera_poses(record, closed);
  for (PoseCovarianceRow& row : rows) row = carried_to(closed.frame_mount, record.mount(), row);
  return rows;
}

}  // namespace oneac::app
