#pragma once

#include "scale/measurements.h"
#include "two_view/two_view.h"

#include "oneac/geometry/camera_frame.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace oneac {

/// Whether calibration and mount, as they are believed, can be those of this drive. While something
/// speaks against them, nothing is in metres.
///
/// From the first image: camera_faults(). From the drive: the direction of travel lies where the
/// mount says that the vehicle's nose is; the road lies below the camera and not above it or to one
/// side; travel does not swing from side to side with every image, as between two cameras.
class SetupCheck {
 public:
  /// The first frame of the drive.
  void start(const CameraFrame& first);
  /// The next step. @param R_level_cam  levelling of its first view, as believed
  void follow(const TwoView& seen, const Eigen::Matrix3d& R_level_cam);

  [[nodiscard]] bool metric_allowed() const { return faults_.empty(); }
  /// What speaks against the set-up, one line each with its cure.
  [[nodiscard]] const std::vector<std::string>& faults() const { return faults_; }
  /// The length, in metres only where the set-up allows it.
  [[nodiscard]] StepLength checked(StepLength length) const;
  [[nodiscard]] ScaleCorrection checked(ScaleCorrection correction) const;

 private:
  /// A step that moved.
  struct Travel {
    double off_heading = 0.0;  ///< [rad] from the vehicle's nose, or tail where it is nearer
    double to_the_left = 0.0;  ///< [rad] with its sign, ahead or back
  };
  /// Where a road was measured: below, as believed, and turned by quarters about the axis.
  using RoadSeen = std::array<bool, 4>;

  void remember(const TwoView& seen, const Eigen::Matrix3d& R_level_cam);
  void look_for_road(const TwoView& seen, const Eigen::Matrix3d& R_level_cam);
  [[nodiscard]] std::vector<std::string> faults_of_drive() const;
  [[nodiscard]] std::optional<std::string> fault_of_swing() const;
  [[nodiscard]] std::optional<std::string> fault_of_heading() const;
  [[nodiscard]] std::optional<std::string> fault_of_road() const;

  std::vector<std::string> of_camera_;
  std::vector<std::string> faults_;
  Eigen::Vector3d nose_ = Eigen::Vector3d::UnitZ();  ///< vehicle's X in the levelled camera
  std::deque<Travel> travels_;                       ///< newest last
  std::deque<RoadSeen> looks_;                       ///< newest last
  std::size_t moved_ = 0;                            ///< steps
};

}  // namespace oneac
