#pragma once

#include "oneac/geometry/camera_frame.h"
#include "oneac/observations/sensor_mount.h"
#include "oneac/rawlog/vehicle_reference.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oneac {

/// What to read from a rawlog.
struct SourceOptions {
  std::filesystem::path log;
  std::filesystem::path images_dir;  ///< folder of external images; empty: searched, see docs
  std::string camera;  ///< "left", "right", a sensor label, or "" when the log leaves no choice
  std::string calibration;  ///< FILE[:SECTION] that overrides the log's; "" keeps the log's
  std::string mount_convention = "auto";  ///< "auto", "optical" or "x_forward" sensor poses
  std::optional<MountAngles> mount;       ///< instead of the orientation of the sensor poses
  std::size_t first = 0;                  ///< first image of the camera to use
  std::size_t count = 0;                  ///< images to use at most; 0: all
  std::size_t every = 1;                  ///< use every K-th image from `first` on; ≥ 1
  bool stereo = false;               ///< load the right image beside the left one, where it exists
  double undistorted_fov_deg = 0.0;  ///< across undistorted images [deg]; 0: the road is kept
  std::optional<PinholeCamera> camera_model = {};  ///< `calibration` by value; goes before it
  std::filesystem::path mask_dir = {};             ///< folder with a mask per image; empty: none

  /// @throws InputError naming flag, value and bound
  void validate() const;
};

/// What a pass over the log met, complete once next() has returned nothing.
struct SourceReport {
  std::size_t images_in_log = 0;    ///< of the selected camera, as far as read
  std::size_t images_missing = 0;   ///< external files that were not found (among those selected)
  std::string first_missing;        ///< name of the first of them
  std::size_t pairs_delivered = 0;  ///< with `stereo`: images delivered with their right one
  std::string first_lone;           ///< name of the first that was delivered without, else ""
  std::string damage;  ///< one line (file, record, fault, cure) when the log ends badly, else ""
  std::string names_out_of_order;   ///< one line with the cure, else ""
  VehicleReference reference;       ///< GPS and IMU seen on the way
  std::size_t wheel_readings = 0;   ///< of the odometer that is followed
  std::string calibration_scaled;   ///< one line: it was given for another size, else ""
  bool undistorted_by_log = false;  ///< images are taken for raw, because the log's calibration is
};

/// One selected image, not decoded yet. Cheap to move between threads.
struct FrameTicket;

/// Streams the images of one camera out of a rawlog in log order, lazily: memory does not grow with
/// the log. Plain, gzip and zstd files; action/sensory-frame and observation logs, mixed too.
///
/// A damaged log gives what is readable before the damage; `report().damage` then says where.
class RawlogSource {
 public:
  /// Opens the log and selects the camera.
  /// @throws InputError (no such file, empty, not a rawlog, no images, no such camera, no images in
  ///         the images dir, no masks in the mask dir, unreadable calibration); labels and sections
  ///         that exist are listed; with `stereo` also when the camera is not the left one of a
  ///         rectified pair
  explicit RawlogSource(const SourceOptions& options);
  ~RawlogSource();
  RawlogSource(RawlogSource&&) noexcept;
  RawlogSource& operator=(RawlogSource&&) noexcept;

  /// Reads on to the next selected image that exists. Not thread-safe.
  /// @throws InputError where a calibration or pose changes, a stamp or a mask is missing
  [[nodiscard]] std::optional<FrameTicket> next();
  /// Decodes, converts to grey, undistorts when distorted (map computed once). Thread-safe.
  /// @throws InputError naming the image when it cannot be decoded or has another size
  ///         than the calibration, or its mask one than it
  [[nodiscard]] CameraFrame load(const FrameTicket& ticket) const;
  /// What the image takes in its file, or in the log [byte]; 0 when it cannot be told.
  /// Thread-safe. Repeated images take as many.
  [[nodiscard]] std::size_t stored_bytes(const FrameTicket& ticket) const;
  /// Reads on (without images) up to two seconds past the last image, so that the reference covers
  /// the drive; then `report` is complete. Call when done.
  void finish();
  /// What was read, missing and passed over so far.
  [[nodiscard]] const SourceReport& report() const;
  /// Share of the file read so far, 0 … 1, for a progress bar.
  [[nodiscard]] double progress() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

struct FrameTicket {
  std::size_t index = 0;
  double time_s = 0.0;
  std::string name;
  /// By the log's wheels, as far as they are known before the image; each goes to one ticket.
  std::vector<SpeedReading> wheels;
  std::shared_ptr<const void> payload;  ///< internal: the observation or the path of its image
};

}  // namespace oneac
