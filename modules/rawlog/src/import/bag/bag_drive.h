#pragma once

#include "import/bag/bag_camera.h"
#include "import/bag/bag_images.h"
#include "import/bag/bag_reader.h"
#include "import/bag/bag_topics.h"
#include "import/image_drive.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace oneac {

/// Makes a drive of the messages of a bag.
class BagDrive {
 public:
  BagDrive(const RosbagImport& options, BagChoice choice);

  /// @throws InputError naming topic and number of a message that is not what it says; OutputError
  ///         when its image cannot be written
  void take(const BagTopic& topic, const BagMessage& message);

  /// Whether there is enough for a log: two images and their camera.
  [[nodiscard]] bool is_complete() const;
  [[nodiscard]] std::size_t images() const { return left_.size(); }

  /// Label, images, times, camera and sensors of the drive. What was assumed goes to the notes.
  /// @throws InputError when there are not two images of different times, no camera, or when a
  ///         pair or an IMU is not what a vehicle has
  [[nodiscard]] ImageDrive drive(ImportReport& report);

 private:
  struct BagImage {
    double time_s;
    std::filesystem::path file;
    double received_s;
    std::size_t number;  ///< of its topic's messages
  };
  struct BagCameraInfo {
    RosCameraInfo info;
    std::string where;
  };

  void take_content(const BagTopic& topic, const BagMessage& message);
  void take_image(const BagTopic& topic, const BagMessage& message, const std::string& prefix,
                  std::vector<BagImage>& images);
  void take_info(const BagTopic& topic, const BagMessage& message,
                 std::optional<BagCameraInfo>& info) const;
  void take_fix(const BagTopic& topic, const BagMessage& message);
  void require_size(const std::string& topic, const RosImage& image);
  [[nodiscard]] double time_of(double header_s, const BagTopic& topic, const BagMessage& message);
  [[nodiscard]] std::string where(const BagTopic& topic, const BagMessage& message) const;

  [[nodiscard]] BagImage image_of(double header_s, std::filesystem::path file,
                                  const BagTopic& topic, const BagMessage& message);
  static void leave_strays_out(const std::string& topic, std::vector<BagImage>& images,
                               ImportReport& report);
  void put_images(ImageDrive& drive, ImportReport& report);
  void put_camera(ImageDrive& drive, ImportReport& report) const;
  void put_right(ImageDrive& drive, ImportReport& report) const;
  void require_vehicles_imu() const;
  void note_times(ImportReport& report) const;

  const RosbagImport& options_;
  BagChoice choice_;
  std::shared_ptr<MadeImages> made_;
  BagImages files_;
  std::vector<BagImage> left_, right_;
  std::map<std::string, std::pair<std::uint32_t, std::uint32_t>> sizes_;  ///< by topic
  std::optional<BagCameraInfo> info_, right_info_;
  std::vector<GpsRecord> gps_;
  std::vector<ImuRecord> imu_;
  std::vector<OdometryRecord> wheels_;
  std::map<std::string, std::size_t> without_time_;  ///< messages, by topic
};

}  // namespace oneac
