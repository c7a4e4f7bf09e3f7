#include "import/bag/ros_messages.h"

#include "oneac/base/number_text.h"
#include "oneac/base/printable.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace oneac {
namespace {

/// Fields of a message in their order: little-endian numbers, texts and lists behind their length.
/// ROS's own reader makes room for what a length says before it looks whether it is there.
class Fields {
 public:
  explicit Fields(const MessageBytes& bytes) : at_(bytes.data()), left_(bytes.size()) {
    static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "as ROS's bags are");
  }

  template <class Number>
  Number number() {
    Number value{};
    std::memcpy(&value, bytes(sizeof value).data, sizeof value);
    return value;
  }
  template <std::size_t kCount>
  std::array<double, kCount> numbers() {
    std::array<double, kCount> values{};
    for (double& value : values) value = number<double>();
    return values;
  }
  std::vector<double> list() {
    const std::size_t count = number<std::uint32_t>();
    if (count > left_ / sizeof(double)) throw BadMessage{"it ends early"};
    std::vector<double> values(count);
    for (double& value : values) value = number<double>();
    return values;
  }
  ByteSpan bytes_behind_length() { return bytes(number<std::uint32_t>()); }
  std::string text() {
    const ByteSpan letters = bytes_behind_length();
    return {reinterpret_cast<const char*>(letters.data), letters.size};
  }
  void require_end() const {
    if (left_ > 0) throw BadMessage{"it goes on for " + std::to_string(left_) + " bytes too many"};
  }

 private:
  ByteSpan bytes(std::size_t count) {
    if (count > left_) throw BadMessage{"it ends early"};
    const ByteSpan span{at_, count};
    at_ += count;
    left_ -= count;
    return span;
  }

  const std::uint8_t* at_;
  std::size_t left_;
};

/// std_msgs/Header. @return its time [s]
double read_header(Fields& fields) {
  constexpr std::uint32_t kSecond_ns = 1000000000;
  fields.number<std::uint32_t>();  // number of the message
  const auto seconds = fields.number<std::uint32_t>();
  const auto nanoseconds = fields.number<std::uint32_t>();
  if (nanoseconds >= kSecond_ns) throw BadMessage{"its time is none"};
  fields.text();  // frame
  return static_cast<double>(seconds) + 1e-9 * static_cast<double>(nanoseconds);
}

template <std::size_t kCount>
void require_finite(const std::array<double, kCount>& values, const char* what) {
  for (const double value : values) {
    if (!std::isfinite(value)) {
      throw BadMessage{std::string(what) + " holds " + exact_text(value)};
    }
  }
}

/// @throws BadMessage where a covariance begins with -1: the sensor does not tell it
void require_told(const std::array<double, 9>& covariance, const char* what) {
  if (covariance[0] == -1.0) throw BadMessage{std::string("it tells no ") + what};
}

Eigen::Vector3d vector(const std::array<double, 3>& values) {
  return Eigen::Vector3d::Map(values.data());
}

}  // namespace

Stamped<RosImage> read_ros_image(const MessageBytes& bytes) {
  Fields fields(bytes);
  Stamped<RosImage> image;
  image.time_s = read_header(fields);
  image.content.height = fields.number<std::uint32_t>();
  image.content.width = fields.number<std::uint32_t>();
  image.content.encoding = fields.text();
  image.content.is_bigendian = fields.number<std::uint8_t>() != 0;
  image.content.step = fields.number<std::uint32_t>();
  image.content.pixels = fields.bytes_behind_length();
  fields.require_end();
  return image;
}

Stamped<RosCompressedImage> read_ros_compressed_image(const MessageBytes& bytes) {
  Fields fields(bytes);
  Stamped<RosCompressedImage> image;
  image.time_s = read_header(fields);
  image.content.format = fields.text();
  image.content.file = fields.bytes_behind_length();
  fields.require_end();
  return image;
}

Stamped<RosCameraInfo> read_ros_camera_info(const MessageBytes& bytes) {
  Fields fields(bytes);
  Stamped<RosCameraInfo> stamped;
  stamped.time_s = read_header(fields);
  RosCameraInfo& info = stamped.content;
  info.height = fields.number<std::uint32_t>();
  info.width = fields.number<std::uint32_t>();
  info.distortion_model = fields.text();
  info.D = fields.list();
  info.K = fields.numbers<9>();
  info.R = fields.numbers<9>();
  info.P = fields.numbers<12>();
  info.binning_x = fields.number<std::uint32_t>();
  info.binning_y = fields.number<std::uint32_t>();
  info.roi_x = fields.number<std::uint32_t>();
  info.roi_y = fields.number<std::uint32_t>();
  info.roi_height = fields.number<std::uint32_t>();
  info.roi_width = fields.number<std::uint32_t>();
  fields.number<std::uint8_t>();  // whether somebody should rectify
  fields.require_end();
  require_finite(info.K, "K");
  require_finite(info.R, "R");
  require_finite(info.P, "P");
  for (const double term : info.D) require_finite(std::array<double, 1>{term}, "D");
  return stamped;
}

Stamped<std::optional<GpsRecord>> read_ros_nav_sat_fix(const MessageBytes& bytes) {
  Fields fields(bytes);
  Stamped<std::optional<GpsRecord>> stamped;
  stamped.time_s = read_header(fields);
  const auto status = fields.number<std::int8_t>();
  fields.number<std::uint16_t>();  // satellites of whom
  const auto place = fields.numbers<3>();
  fields.numbers<9>();            // covariance
  fields.number<std::uint8_t>();  // its kind
  fields.require_end();
  const bool told = std::isfinite(place[0]) && std::isfinite(place[1]);
  if (status < 0 || !told) return stamped;
  if (std::abs(place[0]) > 90.0 || std::abs(place[1]) > 180.0) {
    throw BadMessage{"its latitude or longitude is beyond the range of degrees"};
  }
  GpsRecord fix;
  fix.position = {place[0], place[1], place[2]};
  fix.fix_quality = status > 0 ? 2 : 1;  // NMEA's: differential, plain
  stamped.content = fix;
  return stamped;
}

Stamped<ImuRecord> read_ros_imu(const MessageBytes& bytes) {
  Fields fields(bytes);
  Stamped<ImuRecord> stamped;
  stamped.time_s = read_header(fields);
  fields.numbers<13>();  // orientation and its covariance
  const auto rates = fields.numbers<3>();
  const auto rate_covariance = fields.numbers<9>();
  const auto acceleration = fields.numbers<3>();
  const auto acceleration_covariance = fields.numbers<9>();
  fields.require_end();
  require_told(rate_covariance, "rates of turn");
  require_told(acceleration_covariance, "acceleration");
  require_finite(rates, "angular_velocity");
  require_finite(acceleration, "linear_acceleration");
  stamped.content.angular_rate = vector(rates);
  stamped.content.acceleration = vector(acceleration);
  return stamped;
}

Stamped<OdometryRecord> read_ros_odometry(const MessageBytes& bytes) {
  constexpr double kUnit = 1e-2;  // of a quaternion's length: drivers round
  Fields fields(bytes);
  Stamped<OdometryRecord> stamped;
  stamped.time_s = read_header(fields);
  fields.text();  // frame of the vehicle
  const auto place = fields.numbers<3>();
  const auto q = fields.numbers<4>();  // x, y, z, w
  fields.numbers<36>();                // covariance of the pose
  fields.numbers<42>();                // twist and its covariance
  fields.require_end();
  require_finite(place, "position");
  require_finite(q, "orientation");
  const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  if (std::abs(length - 1.0) > kUnit) throw BadMessage{"its orientation is no rotation"};
  stamped.content.position = {place[0], place[1]};
  stamped.content.heading =
      std::atan2(2.0 * (q[3] * q[2] + q[0] * q[1]), 1.0 - 2.0 * (q[1] * q[1] + q[2] * q[2]));
  return stamped;
}

}  // namespace oneac
