#include "key_flags.h"

#include "oneac/base/error.h"
#include "oneac/base/finite_number.h"
#include "oneac/base/printable.h"

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <system_error>

namespace oneac::app {
namespace {

constexpr std::size_t kLongest = 40;  // [byte] of a value in a message

std::string in_quotes(const std::string& text) {
  return "'" + shortened(printable(text), kLongest) + "'";
}

template <class Bound>
CLI::Validator number_that(const Bound& holds, const std::string& bound, const char* name) {
  return {[holds, bound](std::string& text) {
            const auto value = finite_number(text);
            if (value && holds(*value)) return std::string();
            return in_quotes(text) + " must be a number " + bound;
          },
          name};
}

/// CLI11 gets "8" for "+8" and "08", which it would read in base 8, and nothing that it would cut.
template <class Number>
std::string take_whole(std::string& text) {
  const std::string_view digits = without_plus(text);
  Number value = 0;
  const char* end = digits.data() + digits.size();
  const auto result = std::from_chars(digits.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end) {
    return in_quotes(text) + " must be a whole number from " +
           std::to_string(std::numeric_limits<Number>::min()) + " to " +
           std::to_string(std::numeric_limits<Number>::max());
  }
  text = std::to_string(value);
  return "";
}

std::string take_text(std::string& text) {
  return text.empty() ? "is empty; leave it out, or give a value" : "";
}

std::string take_decimal(std::string& text) {
  return finite_number(text) ? "" : in_quotes(text) + " must be a number";
}

/// The type comes first, then the bounds: "FLOAT:ABOVE 0".
bool is_of_type(const CLI::Option& option, std::string_view type) {
  return option.get_type_name().compare(0, type.size(), type) == 0;
}

Setting setting_of(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos) {
    throw InputError("--set " + text, "has no '='", "write --set section.key=value");
  }
  const std::string key = text.substr(0, equals);
  return {"--set " + key, key, text.substr(equals + 1)};
}

}  // namespace

CLI::Validator above_zero() {
  return number_that([](double value) { return value > 0.0; }, "above 0", "ABOVE 0");
}

CLI::Validator at_least_zero() {
  return number_that([](double value) { return value >= 0.0; }, "of at least 0", "AT LEAST 0");
}

void check_values(CLI::App& program) {
  for (CLI::App* verb : program.get_subcommands({})) {
    for (CLI::Option* option : verb->get_options()) {
      if (is_of_type(*option, "FLOAT")) option->transform(CLI::Validator(take_decimal, ""));
      if (is_of_type(*option, "INT")) option->transform(CLI::Validator(take_whole<int>, ""));
      if (is_of_type(*option, "UINT")) {
        option->transform(CLI::Validator(take_whole<std::uint64_t>, ""));
      }
      if (is_of_type(*option, "TEXT")) option->transform(CLI::Validator(take_text, ""));
    }
    check_values(*verb);
  }
}

void add_parameters(CLI::App& verb, std::vector<std::string>& files,
                    std::vector<Setting>& settings) {
  verb.add_option("--params", files, "YAML with parameters; may be repeated")
      ->allow_extra_args(false);
  verb.add_option_function<std::vector<std::string>>(
          "--set",
          [&settings](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) settings.push_back(setting_of(text));
          },
          "section.key=value, any key of params/default.yaml")
      ->allow_extra_args(false);
}

void add_key(CLI::App& verb, const std::string& flag, const std::string& key,
             std::vector<Setting>& settings, const std::string& help) {
  verb.add_option_function<std::string>(
      flag,
      [&settings, flag, key](const std::string& value) {
        settings.push_back({flag, key, value});
      },
      help);
}

void add_selection(CLI::App& verb, std::vector<Setting>& settings) {
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
