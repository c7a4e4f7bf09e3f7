#pragma once

#include "oneac/geometry/camera.h"

#include <mrpt/img/TCamera.h>

#include <Eigen/Geometry>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace mrpt::img {
class CImage;
}
namespace mrpt::obs {
class CObservation;
}

namespace oneac {

/// One image of an observation with its camera: what an image observation and either half of a
/// stereo observation have in common. Borrows from the observation.
struct CameraView {
  enum class Side { mono, left, right };

  std::string label;  ///< of the sensor
  Side side = Side::mono;
  const mrpt::img::CImage* pixels = nullptr;  ///< never null in what camera_views() gives
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
  /// Whether T_vehicle_sensor and T_left_right are finite and rotate.
  [[nodiscard]] bool has_sound_pose() const;
};

/// The images of an observation: none, one, or the left and right one of a pair, in this order.
[[nodiscard]] std::vector<CameraView> camera_views(const mrpt::obs::CObservation& observation);

/// "the pose of the camera is damaged" (or of the left or right one): what is said of a view
/// without a sound pose.
[[nodiscard]] std::string damaged_pose(const CameraView& view);

/// The calibration as stored in an observation.
/// @throws InputError naming `where` when there is none (not finite, not positive) or its lens
///         model is none of LensModel's
[[nodiscard]] PinholeCamera to_pinhole(const mrpt::img::TCamera& camera, const std::string& where);

/// k1 … k4 of a fisheye out of TCamera::dist: MRPT's setters leave [k1 k2 0 0 k3 k4], its readers
/// of vectors and files [k1 k2 k3 k4]. Empty when both places are in use.
[[nodiscard]] std::optional<std::array<double, 4>> fisheye_terms_of_mrpt(
    const std::array<double, 8>& dist);

/// Baseline [m] of a pair whose rows correspond: parallel, side by side, equal calibrations; empty
/// for any other pair, and for one whose images are not rectified.
/// @param overridden  the calibration is not the observation's; then it is that of both images
[[nodiscard]] std::optional<double> rectified_baseline(const CameraView& right,
                                                       const PinholeCamera& left, bool overridden);

}  // namespace oneac
