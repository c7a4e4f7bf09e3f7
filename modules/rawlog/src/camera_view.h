#pragma once

#include "log_image.h"
#include "log_reader.h"

#include "oneac/geometry/camera.h"

#include <mrpt/img/TCamera.h>

#include <Eigen/Geometry>

#include <memory>
#include <string>
#include <vector>

namespace oneac {

/// One image of an observation with its camera: what an image observation and either half of a
/// stereo observation have in common. Borrows from the record.
struct CameraView {
  enum class Side { mono, left, right };

  std::string label;  ///< of the sensor
  Side side = Side::mono;
  std::shared_ptr<const LogImage> image;  ///< never null
  const mrpt::img::TCamera* calibration = nullptr;
  Eigen::Isometry3d T_vehicle_sensor =
      Eigen::Isometry3d::Identity();  ///< of the left camera of a pair
  Eigen::Isometry3d T_left_right =
      Eigen::Isometry3d::Identity();  ///< optical axes; right side only

  /// "LABEL", "LABEL/left" or "LABEL/right": what selects this camera and no other.
  [[nodiscard]] std::string name() const;
  /// Whether the user's --camera means this one ("left", "right", a label, or name(); a stereo
  /// label alone means its left camera).
  [[nodiscard]] bool matches(const std::string& camera) const;
  /// "left", "right" or "": the half of a pair, or what the label says.
  [[nodiscard]] std::string side_name() const;
  /// This camera in the optical frame of the left one. Rectified images of a pair whose stored
  /// calibration is raw belong to cameras that were turned parallel: only the baseline is left.
  [[nodiscard]] Eigen::Isometry3d offset_in_pair(bool images_rectified) const;
};

/// The images of an observation: none, one, or the left and right one of a pair.
[[nodiscard]] std::vector<CameraView> camera_views(const RawlogRecord& record);

/// @throws std::runtime_error when the pose of a camera is not finite or not a rotation
void check_cameras(const mrpt::obs::CObservation& observation);

/// The calibration as stored in a log.
/// @throws InputError naming `where` when there is none or its lens model is not supported
[[nodiscard]] PinholeCamera to_pinhole(const mrpt::img::TCamera& camera, const std::string& where);

}  // namespace oneac
