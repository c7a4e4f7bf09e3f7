#pragma once

#include "arrays.h"

#include "oneac/geometry/camera.h"
#include "oneac/geometry/camera_frame.h"

#include <memory>

namespace oneac::python {

using Pixels = py::array_t<std::uint8_t, py::array::c_style>;

/// Grey (height, width) or, with `colour`, also RGB (height, width, 3), 8 bits.
/// @throws std::invalid_argument naming shape or type, and what it must be
[[nodiscard]] Pixels pixels_from(const py::object& image, bool colour, const char* name = "image");
/// Of a grey one; it lives as long as that.
[[nodiscard]] ImageView view_of(const Pixels& grey);
/// @throws std::invalid_argument for a time that is not finite or beyond what a clock tells
void require_time(double time_s);
/// What a frame may have beside its image; None for none.
struct FrameExtras {
  py::object mask, right, right_mask;
  double baseline_m = 0.0;
};
/// A frame of an image without distortion. @throws std::invalid_argument
[[nodiscard]] std::shared_ptr<CameraFrame> frame_from(const py::object& image, double time_s,
                                                      const PinholeCamera& camera,
                                                      std::size_t index,
                                                      const py::object& T_vehicle_cam,
                                                      const FrameExtras& extras);

}  // namespace oneac::python
