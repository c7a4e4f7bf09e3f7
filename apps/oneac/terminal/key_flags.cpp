#include "key_flags.h"

#include "oneac/base/finite_number.h"
#include "oneac/base/printable.h"

#include <cstddef>

namespace oneac::app {
namespace {

constexpr std::size_t kLongest = 40;  // [byte] of a value in a message

template <class Bound>
CLI::Validator number_that(const Bound& holds, const std::string& bound, const char* name) {
  return {[holds, bound](std::string& text) {
            const auto value = finite_number(text);
            if (value && holds(*value)) return std::string();
            return "'" + shortened(printable(text), kLongest) + "' must be a number " + bound;
          },
          name};
}

}  // namespace

CLI::Validator above_zero() {
  return number_that([](double value) { return value > 0.0; }, "above 0", "ABOVE 0");
}

CLI::Validator at_least_zero() {
  return number_that([](double value) { return value >= 0.0; }, "of at least 0", "AT LEAST 0");
}

void add_key(CLI::App& verb, const std::string& flag, const std::string& key,
             std::vector<std::string>& settings, const std::string& help) {
  verb.add_option_function<std::string>(
      flag, [&settings, key](const std::string& value) { settings.push_back(key + "=" + value); },
      help);
}

void add_selection(CLI::App& verb, std::vector<std::string>& settings) {
  add_key(verb, "--features", "front_end.features.extractor", settings,
          "klt, vlfeat, vlfeat+align or sift");
  add_key(verb, "--images-dir", "source.images_dir", settings, "folder of the external images");
  add_key(verb, "--mask-dir", "source.mask_dir", settings,
          "folder with a mask per image, called as it is (000003.png): dark where pixels are not "
          "used");
  add_key(verb, "--camera", "source.camera", settings, "left, right or a sensor label");
  add_key(
      verb, "--calibration", "source.calibration", settings,
      "FILE[:SECTION] instead of the log's: MRPT, KITTI, OpenCV, ROS, Kalibr, COLMAP, ORB-SLAM");
  add_key(
      verb, "--undistorted-fov", "source.undistorted_fov_deg", settings,
      "degrees across the undistorted images of a camera with distortion; 0: chosen to keep the "
      "road");
  add_key(verb, "--mount-convention", "source.mount_convention", settings,
          "axes of the log's sensor poses: auto, optical or x_forward");
  add_key(verb, "--mount-roll", "source.mount_roll_deg", settings,
          "degrees that the camera is turned to the right about its optical axis: 180 upside down, "
          "90 or -90 portrait. With one of --mount-roll, -pitch, -yaw the log's orientation is not "
          "used, and those left out are 0");
  add_key(verb, "--mount-pitch", "source.mount_pitch_deg", settings,
          "degrees that it looks above the horizon");
  add_key(verb, "--mount-yaw", "source.mount_yaw_deg", settings,
          "degrees that it looks to the left: 90 left, -90 right, 180 rear");
  add_key(verb, "--first", "source.first", settings, "first image to use, from 0");
  add_key(verb, "--count", "source.count", settings, "images to use at most; 0: all");
  add_key(verb, "--every", "source.every", settings, "use every K-th image");
}

}  // namespace oneac::app
