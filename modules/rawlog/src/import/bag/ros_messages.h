#pragma once

#include "oneac/rawlog/sensor_records.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace oneac {

/// A part of the bytes of a message.
struct ByteSpan {
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;
};

/// sensor_msgs/Image; `pixels` lie in the message.
struct RosImage {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::string encoding;
  bool is_bigendian = false;
  std::uint32_t step = 0;  ///< bytes of a row
  ByteSpan pixels;
};

/// sensor_msgs/CompressedImage; `file` lies in the message.
struct RosCompressedImage {
  std::string format;
  ByteSpan file;
};

/// sensor_msgs/CameraInfo.
struct RosCameraInfo {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::string distortion_model;
  std::vector<double> D;
  std::array<double, 9> K{};
  std::array<double, 9> R{};
  std::array<double, 12> P{};
  std::uint32_t binning_x = 0;
  std::uint32_t binning_y = 0;
  std::uint32_t roi_x = 0;
  std::uint32_t roi_y = 0;
  std::uint32_t roi_width = 0;
  std::uint32_t roi_height = 0;
};

/// Time of a header [s]; 0: the header tells none.
template <class Content>
struct Stamped {
  double time_s = 0.0;
  Content content;
};

/// What the types of messages that are read are called, and the MD5 of ROS 1's definition of them.
struct RosType {
  const char* name;
  const char* md5;
};
inline constexpr RosType kRosImage{"sensor_msgs/Image", "060021388200f6f0f447d0fcd9c64743"};
inline constexpr RosType kRosCompressedImage{"sensor_msgs/CompressedImage",
                                             "8f7a12909da2c9d3332d540a0977563f"};
inline constexpr RosType kRosCameraInfo{"sensor_msgs/CameraInfo",
                                        "c9a58c1b0b154e0e6da7578cb991d214"};
inline constexpr RosType kRosNavSatFix{"sensor_msgs/NavSatFix", "2d3a8cd499b9b4a0249fb98fd05cfa48"};
inline constexpr RosType kRosImu{"sensor_msgs/Imu", "6a62c6daae103f4ff57a132d6f95cec2"};
inline constexpr RosType kRosOdometry{"nav_msgs/Odometry", "cd5e73d190d741a2f92e81eda573aca7"};

// Each reads the bytes of one message. @throws BadMessage for bytes that end early or go on behind
// it, and for numbers that no sensor tells

/// What is wrong with a message, in a few words.
struct BadMessage {
  std::string fault;
};

using MessageBytes = std::vector<std::uint8_t>;
[[nodiscard]] Stamped<RosImage> read_ros_image(const MessageBytes& bytes);
[[nodiscard]] Stamped<RosCompressedImage> read_ros_compressed_image(const MessageBytes& bytes);
[[nodiscard]] Stamped<RosCameraInfo> read_ros_camera_info(const MessageBytes& bytes);
/// Empty for one without a fix; an altitude that is not told is NaN.
[[nodiscard]] Stamped<std::optional<GpsRecord>> read_ros_nav_sat_fix(const MessageBytes& bytes);
[[nodiscard]] Stamped<ImuRecord> read_ros_imu(const MessageBytes& bytes);
[[nodiscard]] Stamped<OdometryRecord> read_ros_odometry(const MessageBytes& bytes);

}  // namespace oneac
