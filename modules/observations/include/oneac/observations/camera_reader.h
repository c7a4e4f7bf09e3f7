#pragma once

#include "oneac/base/image.h"
#include "oneac/geometry/camera.h"
#include "oneac/observations/camera_view.h"
#include "oneac/observations/sensor_mount.h"

#include <mrpt/core/Clock.h>
#include <mrpt/img/TCamera.h>

#include <Eigen/Geometry>

#include <memory>
#include <optional>
#include <string>

namespace oneac {

/// A camera as its first image describes it.
struct CameraDescription {
  std::string name;       ///< CameraView::name()
  std::string label;      ///< of the sensor
  std::string side_name;  ///< CameraView::side_name()
  CameraView::Side side = CameraView::Side::mono;
  mrpt::img::TCamera calibration;
  Eigen::Isometry3d T_vehicle_sensor = Eigen::Isometry3d::Identity();

  [[nodiscard]] static CameraDescription of(const CameraView& view);
};

/// How to read a camera.
struct CameraReaderOptions {
  std::string mount_convention = "auto";     ///< "auto", "optical" or "x_forward" sensor poses
  std::optional<PinholeCamera> calibration;  ///< instead of that of the observations
  bool stereo = false;                       ///< the right image of a pair is wanted too
  /// Instead of the orientation of the observations, whose positions are kept
  std::optional<MountAngles> mount;
  /// Across the undistorted images [deg]; 0: chosen to keep the road, see Undistorter
  double undistorted_fov_deg = 0.0;
};

/// One camera of a log or of a running vehicle: what makes a CameraFrame of its images, and the
/// only place that says which of them cannot be used. The first image decides on calibration and
/// axes of the sensor pose; an image that contradicts it is refused.
///
/// Immutable but for the map of the undistortion; const members are thread-safe.
class CameraReader {
 public:
  /// @param where  of the first image, for messages: "drive.rawlog: record 4"
  /// @throws InputError: no calibration, a lens model that MRPT does not name, a pose that is not
  ///         finite, an unknown convention, a pose of which neither convention makes a usual
  ///         mount ("auto", without `mount`); with `stereo` a camera that is not the left one
  CameraReader(const CameraDescription& first, const CameraReaderOptions& options,
               const std::string& where);
  ~CameraReader();
  CameraReader(CameraReader&&) noexcept;
  CameraReader& operator=(CameraReader&&) noexcept;

  /// @throws InputError when the image's calibration is not that of the first
  void check_calibration(const CameraView& view, const std::string& where) const;
  /// Length of the baseline of the pair [m].
  /// @throws InputError when the images are not rectified: their rows would not correspond
  [[nodiscard]] double baseline(const CameraView& right, const std::string& where) const;
  /// Unix time [s]. @throws InputError for an image without time stamp
  [[nodiscard]] static double time_of(const mrpt::Clock::time_point& stamp,
                                      const std::string& where);
  /// T_vehicle_cam of the optical frame. @throws InputError for a pose that is not finite
  [[nodiscard]] Eigen::Isometry3d mount(const CameraView& view) const;
  /// Undistorts when distorted.
  /// @throws InputError naming the image when its size is not the calibration's (a given one is
  ///         scaled where only the size differs) or changes
  [[nodiscard]] GreyImage rectify(GreyImage grey, const std::string& name) const;
  /// What is not used of a rectified image, dark: what its mask says, of the image as it is stored,
  /// and the rim that undistortion leaves black. Empty where all is used.
  /// @param mask  empty: none
  [[nodiscard]] GreyImage unused(const GreyImage& rectified, GreyImage mask,
                                 const std::string& name) const;
  /// One line when the given calibration is for images of another size and the same aspect, and was
  /// scaled to these; else "". Complete once an image was rectified. Thread-safe.
  [[nodiscard]] std::string scaling_note() const;
  /// The camera of the rectified images.
  [[nodiscard]] PinholeCamera rectified_camera(const GreyImage& image) const;
  /// The calibration in use, of the images as they are stored.
  [[nodiscard]] PinholeCamera raw_camera(const GreyImage& image) const;
  /// The calibration in use has distortion: images are taken for raw.
  [[nodiscard]] bool undistorts() const;

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace oneac
