#pragma once

#include "scale/measurements.h"
#include "two_view/two_view.h"

#include "oneac/geometry/camera_frame.h"
#include "oneac/observations/sensor_mount.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace oneac {

/// Whether calibration and mount, as they are believed, can be those of this drive. While something
/// speaks against them, nothing is in metres.
///
/// From the first image: camera_faults(). From the whole drive up to now: the direction of travel
/// lies where the mount says that the vehicle's nose is; the road lies below the camera and not
/// above it or to one side; travel does not swing from side to side with every image, as between
/// two cameras; the pitch of a camera that looks aside was told; lengths are no speeds that no car
/// drives. A drive that once showed its road below, again and again, is not accused in a tunnel:
/// what is said can be taken back, and what stands at the end holds for the whole drive.
///
/// Walls, hedges, barriers and ceilings are planes along the way, too. A road differs from them: it
/// is nearer than all others, and reaches to both sides of the point below the camera. A wall
/// begins at the ground, which is nearer.
class SetupCheck {
 public:
  /// The first frame of the drive.
  void start(const CameraFrame& first);
  /// The next step. @param R_level_cam  levelling of its first view, as believed
  void follow(const TwoView& seen, const Eigen::Matrix3d& R_level_cam);

  /// What the drive says against the focal length, or nothing; holds until told otherwise.
  void blame_camera(const std::optional<std::string>& fault);

  [[nodiscard]] bool metric_allowed() const { return faults_.empty(); }
  /// What speaks against the set-up, one line each with its cure.
  [[nodiscard]] const std::vector<std::string>& faults() const { return faults_; }
  /// The length of the newest step, in metres only where the set-up, this step included, allows it.
  [[nodiscard]] StepLength checked_after(StepLength length);
  [[nodiscard]] ScaleCorrection checked(ScaleCorrection correction) const;

 private:
  /// Of all steps that moved: a mount does not change during a drive.
  struct Travels {
    std::size_t count = 0, off = 0, swings = 0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();  ///< of directions, in the levelled camera
    double last_to_the_left = 0.0;                  ///< [rad] of its line, with its sign
  };
  /// Looks, and those in which the road lay below, as believed, or a quarter turn or two from it.
  struct Looks {
    std::size_t count = 0;
    std::array<std::size_t, 4> road{};
  };

  /// Of all steps whose length somebody told.
  struct Speeds {
    std::size_t count = 0, too_fast = 0;
  };

  void remember(const TwoView& seen, const Eigen::Matrix3d& R_level_cam);
  void look_for_road(const TwoView& seen, const Eigen::Matrix3d& R_level_cam);
  [[nodiscard]] std::vector<std::string> faults_of_drive() const;
  [[nodiscard]] std::optional<std::string> fault_of_swing() const;
  [[nodiscard]] std::optional<std::string> fault_of_heading() const;
  [[nodiscard]] std::optional<std::string> fault_of_road() const;
  [[nodiscard]] std::optional<std::string> fault_of_pitch() const;
  [[nodiscard]] std::optional<std::string> fault_of_speed() const;

  void gather();

  std::vector<std::string> of_camera_;
  std::vector<std::string> of_drive_;
  std::optional<std::string> of_focal_;
  std::vector<std::string> faults_;
  MountAngles believed_;
  Eigen::Vector3d nose_ = Eigen::Vector3d::UnitZ();  ///< vehicle's X in the levelled camera
  bool pitch_is_missing_ = false;                    ///< of a camera that looks aside
  Speeds speeds_;
  Travels travels_;
  Looks looks_;
};

}  // namespace oneac
