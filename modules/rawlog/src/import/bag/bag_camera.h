#pragma once

#include "calibration/calibration_numbers.h"
#include "import/bag/ros_messages.h"

#include "oneac/geometry/camera.h"

#include <string>

namespace oneac {

/// Whether a topic's name says that its images are rectified: "image_rect", "image_rect_color".
[[nodiscard]] bool is_rectified_topic(const std::string& topic);

/// The camera of images of a topic: K and D, or P of rectified images, for the part of the sensor
/// (region of interest, binning) that they show.
/// @throws InputError naming the place for a camera that is not calibrated, or whose lens is of
///         another model
[[nodiscard]] PinholeCamera camera_of(const RosCameraInfo& info, bool rectified,
                                      const CalibrationPlace& place);

/// Whether raw images are those of a rectified pair: no distortion, no rotation, K as in P.
[[nodiscard]] bool needs_no_rectifying(const RosCameraInfo& info);

/// Whether two cameras of a rectified pair differ by their place alone: f, cx and cy of P.
[[nodiscard]] bool is_same_projection(const RosCameraInfo& a, const RosCameraInfo& b);

/// Place of a camera of a rectified pair along its X axis [m], by P.
[[nodiscard]] double place_in_pair(const RosCameraInfo& info);

/// Whether two messages tell the same camera, but for digits of which no pixel knows.
[[nodiscard]] bool is_same_camera(const RosCameraInfo& a, const RosCameraInfo& b);

}  // namespace oneac
