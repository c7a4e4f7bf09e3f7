#pragma once

#include "oneac/rawlog/import_drive.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace oneac {

/// A bag of ROS 1. Topics are named as in the bag.
struct RosbagImport : DriveImport {
  std::string image_topic;        ///< Image or CompressedImage; "": the only one there is
  std::string right_topic;        ///< of the right camera of a rectified pair; "": no pair
  std::string camera_info_topic;  ///< CameraInfo; "": the one beside the images, or the only one
  std::string gps_topic;          ///< NavSatFix; "": the only one there is
  std::string imu_topic;          ///< Imu whose axes are the vehicle's; "": none
  std::string wheels_topic;       ///< Odometry of wheels; "": none
};

/// A topic of a bag.
struct BagTopic {
  std::string name;
  std::string type;  ///< such as "sensor_msgs/Image"
  std::string md5;   ///< of the definition of its messages
  std::size_t messages = 0;
};

/// Whether its messages are images that are read: Image or CompressedImage of sensor_msgs.
[[nodiscard]] bool has_images(const BagTopic& topic);

/// The topics of a bag, by their names. @throws InputError as import_rosbag()
[[nodiscard]] std::vector<BagTopic> topics_of_bag(const std::filesystem::path& bag);

/// Writes a drive out of a bag of ROS 1: Image (mono, rgb, bgr, rgba, bgra and Bayer patterns of 8
/// or 16 bits, yuv422 in either order) as PNG files, CompressedImage as the JPEG or PNG files that
/// they are, all in <log base>_Images. Times are those of the headers, or of the bag where they are
/// 0, and a note says so. The calibration is CameraInfo's: K and D, or P where the topic's name
/// says that its images are rectified ("image_rect"). Where the bag is damaged, or a message is not
/// what it says, the log holds what came before; then the error is thrown.
/// @throws InputError naming bag, topic and number of the message (from 1 on), what is wrong with
/// it
///         and the cure; for a bag of ROS 2; where this oneac cannot read bags. OutputError when
///         log or images cannot be written
ImportReport import_rosbag(const RosbagImport& options);

}  // namespace oneac
