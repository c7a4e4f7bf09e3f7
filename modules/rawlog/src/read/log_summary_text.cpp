#include "read/log_layout.h"

#include "oneac/base/printable.h"
#include "oneac/geometry/levelling.h"
#include "oneac/rawlog/log_summary.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace oneac {
namespace {

constexpr double kDegrees = 180.0 / M_PI;

// printf into a string, so that the widths of a table stay readable.
[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  std::va_list again;
  va_copy(again, arguments);
  const int length = std::vsnprintf(nullptr, 0, format, arguments);
  va_end(arguments);
  std::string result(static_cast<std::size_t>(std::max(0, length)) + 1, '\0');
  std::vsnprintf(result.data(), result.size(), format, again);
  va_end(again);
  result.pop_back();
  return result;
}

std::string shown(const std::string& label) {
  return label.empty() ? "(no label)" : label;
}

std::string sensor_lines(const LogSummary& summary) {
  std::string lines = "sensors\n";
  std::size_t width = 0;
  std::size_t class_width = 0;
  for (const auto& sensor : summary.sensors) {
    width = std::max(width, shown(sensor.label).size());
    class_width = std::max(class_width, sensor.class_name.size());
  }
  for (const auto& sensor : summary.sensors) {
    lines += text("  %-*s  %-*s  %7zu", static_cast<int>(width), shown(sensor.label).c_str(),
                  static_cast<int>(class_width), sensor.class_name.c_str(), sensor.count);
    if (sensor.rate_hz) lines += text("  %8.2f Hz", *sensor.rate_hz);
    if (sensor.first_s) {
      lines += text("  from %.3f s to %.3f s", *sensor.first_s - *summary.first_s,
                    *sensor.last_s - *summary.first_s);
    }
    lines += "\n";
  }
  return lines;
}

std::string image_lines(const LogSummary& summary) {
  std::size_t present = 0;
  std::size_t images = 0;
  std::string per_camera;
  for (const auto& camera : summary.cameras) {
    present += camera.present;
    images += camera.images;
    per_camera += text("  %s: %zu of %zu present, %zu missing\n", shown(camera.name).c_str(),
                       camera.present, camera.images, camera.images - camera.present);
  }
  std::string lines = text("images: %zu of %zu present\n", present, images) + per_camera;
  for (const auto& folder : summary.image_folders)
    lines += "  found in " + printable(folder) + "\n";
  if (present < images) lines += "  searched " + summary.searched_folders + "\n";
  return lines;
}

std::string calibration_text(const CameraSummary& camera, bool overridden) {
  if (!camera.calibration) return "none usable: " + camera.calibration_fault;
  const auto& c = *camera.calibration;
  std::string line = c.is_distorted() ? "raw, " : "rectified, ";
  if (c.width > 0) line += text("%dx%d, ", c.width, c.height);
  line += text("f (%.5g, %.5g) px, c (%.5g, %.5g) px", c.fx, c.fy, c.cx, c.cy);
  const auto& k = c.distortion;
  if (c.lens == LensModel::kannala_brandt) {
    line += text(", fisheye k1 k2 k3 k4 = %.4g %.4g %.4g %.4g", k[0], k[1], k[2], k[3]);
  } else if (c.is_distorted()) {
    line += text(", k1 k2 p1 p2 k3 = %.4g %.4g %.4g %.4g %.4g", k[0], k[1], k[2], k[3], k[4]);
    const bool rational = k[5] != 0.0 || k[6] != 0.0 || k[7] != 0.0;
    if (rational) line += text(", k4 k5 k6 = %.4g %.4g %.4g", k[5], k[6], k[7]);
  }
  return line + (overridden ? " (given by --calibration)" : " (from the log)");
}

// "8.2° upward"; a tilt that prints as zero has no direction.
std::string angle_text(double angle, const char* positive, const char* negative) {
  const double degrees = angle * kDegrees;
  constexpr double kPrintsAsZero = 0.05;
  if (std::abs(degrees) < kPrintsAsZero) return "0.0°";
  return text("%.1f° %s", std::abs(degrees), degrees > 0.0 ? positive : negative);
}

std::string mount_text(const SensorMount& mount) {
  const Eigen::Vector3d p = mount.T_vehicle_cam.translation();
  const Tilt tilt = tilt_from_mounting(mount.T_vehicle_cam.linear());
  // + 0.0 turns a negative zero into a positive one
  return text("at (%.3f, %.3f, %.3f) m, tilt ", p.x() + 0.0, p.y() + 0.0, p.z() + 0.0) +
         angle_text(tilt.pitch_up, "upward", "downward") + ", roll " +
         angle_text(tilt.roll_right, "to the right", "to the left") + ", sensor axes " +
         to_string(mount.convention);
}

std::string camera_lines(const LogSummary& summary) {
  std::string lines = image_lines(summary);
  for (const auto& camera : summary.cameras) {
    lines += "camera " + shown(camera.name) + "\n";
    lines += "  calibration " + calibration_text(camera, summary.calibration_overridden) + "\n";
    lines += "  mount " + mount_text(camera.mount) + "\n";
  }
  return lines;
}

std::string reference_lines(const LogSummary& summary) {
  std::string lines;
  if (summary.gps_observations > 0) {
    lines += text("GPS: %zu observations, %zu epochs with position, %zu with speed\n",
                  summary.gps_observations, summary.gps_epochs_with_position,
                  summary.gps_epochs_with_speed);
  }
  if (summary.imu_observations > 0) {
    lines += text("IMU: %zu observations\n", summary.imu_observations);
  }
  if (summary.wheel_observations > 0) {
    lines += text("wheels: %zu observations\n", summary.wheel_observations);
  }
  return lines;
}

}  // namespace

std::string to_text(const LogSummary& summary) {
  std::string lines = printable(summary.log.string()) + "\n";
  lines += text("format: %s, %s, %zu observations\n", summary.format.c_str(),
                summary.compression.c_str(), summary.observations);
  if (summary.first_s) {
    lines += text("duration: %.1f s, from %.6f to %.6f (Unix time)\n",
                  *summary.last_s - *summary.first_s, *summary.first_s, *summary.last_s);
  }
  lines += sensor_lines(summary);
  lines += summary.cameras.empty() ? "images: none\n" : camera_lines(summary);
  return lines + reference_lines(summary) + missing_lines(summary);
}

}  // namespace oneac
