#pragma once

#include "import/made_images.h"

#include "oneac/geometry/camera.h"
#include "oneac/rawlog/import_drive.h"
#include "oneac/rawlog/sensor_records.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oneac {

/// [m] of KITTI's cameras above the road.
constexpr double kKittiHeight_m = 1.65;

/// The right images of a rectified pair.
struct RightImages {
  std::vector<std::filesystem::path> images;  ///< one for each left image; "": there is none
  double baseline_m = 0.0;
};

/// Everything that an importer puts into a log.
struct ImageDrive {
  std::string label;
  std::vector<std::filesystem::path> images;
  std::shared_ptr<MadeImages> made;  ///< they lie in its folder; null: they were there before
  std::vector<double> times_s;       ///< Unix times, one per image, increasing
  PinholeCamera camera;
  std::optional<RightImages> right;
  Eigen::Isometry3d T_vehicle_cam = Eigen::Isometry3d::Identity();
  MountConvention convention = MountConvention::optical;
  std::vector<GpsRecord> gps;
  std::vector<ImuRecord> imu;
  std::vector<OdometryRecord> wheels;
};

/// Writes the drive in the order of its times and counts it.
void write_drive(const ImageDrive& drive, const std::filesystem::path& log, bool copy_images,
                 ImportReport& report);

/// Says that poses beside the log, which this import has not written, are taken for its truth.
void note_strange_poses(const std::filesystem::path& log, ImportReport& report);

/// The calibration for images of one size: scaled, and said, where only its size differs.
/// @param file_and_section  as of load_calibration()
/// @throws InputError when it is that of images of another aspect
[[nodiscard]] PinholeCamera calibration_for(const std::string& file_and_section,
                                            const std::filesystem::path& image,
                                            ImportReport& report);

/// The same of a camera that is known already. @param where  for the error
[[nodiscard]] PinholeCamera fitted_to(const std::filesystem::path& image, PinholeCamera camera,
                                      const std::string& where, ImportReport& report);

/// The same out of --calibration. @throws InputError when none is given
[[nodiscard]] PinholeCamera given_calibration(const DriveImport& options,
                                              const std::filesystem::path& image,
                                              ImportReport& report);

/// @throws InputError when it is none of a vehicle's camera
void require_camera_height(double height_m);

/// [m] above the road; 0, and said: nobody knows.
[[nodiscard]] double height_above_road(const DriveImport& options, ImportReport& report);

/// The mount of --mount-* at a height. @throws InputError for angles out of bounds
[[nodiscard]] Eigen::Isometry3d mount_at(const MountAngles& mount, double height_m);

/// Says which way the images go when their names in alphabetical order would go another.
void note_order(const std::vector<std::filesystem::path>& images, ImportReport& report);

/// Those of --fps. @throws InputError for a rate that no camera has
[[nodiscard]] std::vector<double> stamps_of_fps(double fps, std::size_t images);

/// Whether the cameras of a pair on a vehicle can be so far apart [m].
[[nodiscard]] bool is_baseline(double baseline_m);

/// The files of `folder` with the names of the left images, and the baseline between two
/// projections "P0" and "P1" of a KITTI calibration file; none, with a note, where they do not fit.
[[nodiscard]] std::optional<RightImages> kitti_right_images(
    const std::vector<std::filesystem::path>& left, const std::filesystem::path& folder,
    const std::filesystem::path& calibration, const std::string& left_projection,
    const std::string& right_projection, ImportReport& report);

/// The same by the file of --calibration, where that is one of KITTI's.
/// @param given  FILE[:SECTION]
[[nodiscard]] std::optional<RightImages> given_right_images(
    const std::vector<std::filesystem::path>& left, const std::filesystem::path& folder,
    const std::string& given, const std::string& left_projection,
    const std::string& right_projection, ImportReport& report);

}  // namespace oneac
