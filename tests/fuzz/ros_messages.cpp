// A message of ROS 1: the first byte says which, the rest are its bytes.
#include "import/bag/ros_messages.h"

#include "fuzz.h"
#include "import/bag/bag_camera.h"

#include "oneac/base/error.h"

#include <cmath>
#include <string>

namespace {

using oneac::MessageBytes;
using oneac::fuzz::check;

void read_camera(const MessageBytes& bytes) {
  const auto info = oneac::read_ros_camera_info(bytes);
  const oneac::CalibrationPlace place("bag", "message");
  for (const bool rectified : {false, true}) {
    const oneac::PinholeCamera camera = oneac::camera_of(info.content, rectified, place);
    check(camera.width > 0 && camera.fx > 0.0 && std::isfinite(camera.cx), "a camera");
  }
}

void read_message(std::uint8_t kind, const MessageBytes& bytes) {
  constexpr std::uint8_t kKinds = 6;
  switch (kind % kKinds) {
    case 0:
      check(oneac::read_ros_image(bytes).content.pixels.size <= bytes.size(), "pixels");
      break;
    case 1:
      check(oneac::read_ros_compressed_image(bytes).content.file.size <= bytes.size(), "file");
      break;
    case 2:
      read_camera(bytes);
      break;
    case 3: {
      const auto fix = oneac::read_ros_nav_sat_fix(bytes);
      check(!fix.content || std::isfinite(fix.content->position.latitude_deg), "a place");
      break;
    }
    case 4:
      check(oneac::read_ros_imu(bytes).content.acceleration.allFinite(), "an IMU");
      break;
    default: {
      const auto odometry = oneac::read_ros_odometry(bytes);
      check(odometry.content.position.allFinite() && std::isfinite(odometry.content.heading),
            "a way");
    }
  }
}

}  // namespace

ONEAC_FUZZ_TARGET(ros_messages) {
  if (data.empty()) return;
  try {
    read_message(static_cast<std::uint8_t>(data.front()), {data.begin() + 1, data.end()});
  } catch (const oneac::BadMessage&) {  // what it may throw
  } catch (const oneac::InputError&) {
  }
}
