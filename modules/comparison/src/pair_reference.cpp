#include "oneac/comparison/pair_reference.h"

#include "oneac/evaluation/association.h"

#include <cmath>
#include <utility>

namespace oneac {
PairReference::PairReference(Trajectory poses, const std::vector<ImageMoment>& images)
    : poses_(std::move(poses)) {
  std::vector<double> times;
  times.reserve(images.size());
  for (const ImageMoment& image : images) times.push_back(image.time_s);
  tolerance_ = time_tolerance(times);
}

PairReference::PairReference(VehicleReference vehicle, const Eigen::Matrix3d& R_level_cam)
    : vehicle_(std::move(vehicle)), R_level_cam_(R_level_cam) {}

const Eigen::Isometry3d* PairReference::pose(const ImageMoment& image) const {
  if (poses_->has_times()) {
    const auto row = nearest_row(poses_->times, image.time_s, tolerance_);
    return row ? &poses_->poses[*row] : nullptr;
  }
  return image.index < poses_->poses.size() ? &poses_->poses[image.index] : nullptr;
}

std::optional<RelativePose> PairReference::motion(const ImageMoment& first,
                                                  const ImageMoment& second) const {
  if (poses_) {
    const Eigen::Isometry3d* T_world_1 = pose(first);
    const Eigen::Isometry3d* T_world_2 = pose(second);
    if (T_world_1 == nullptr || T_world_2 == nullptr) return std::nullopt;
    const Eigen::Isometry3d T_2_1 = T_world_2->inverse() * *T_world_1;
    return RelativePose{T_2_1.linear(), T_2_1.translation()};
  }
  const auto turn = vehicle_.heading_change(first.time_s, second.time_s);
  if (!turn) return std::nullopt;
  // A heading counts counter-clockwise, a yaw of the camera to the right.
  const RelativePose level{yaw_rotation(std::cos(*turn), -std::sin(*turn)),
                           Eigen::Vector3d::Zero()};
  return unlevel(level, R_level_cam_);
}

}  // namespace oneac
