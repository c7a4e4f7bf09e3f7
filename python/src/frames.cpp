#include "frames.h"

#include "oneac/observations/sensor_readings.h"

#include <cmath>
#include <stdexcept>

namespace oneac::python {

namespace {

/// Of the size of the frame's image; empty for None. @throws std::invalid_argument
GreyImage beside(const CameraFrame& frame, const py::object& image, const char* name) {
  if (image.is_none()) return {};
  const Pixels pixels = pixels_from(image, false, name);
  const ImageView view = view_of(pixels);
  if (view.width == frame.image.width() && view.height == frame.image.height()) {
    return GreyImage(view);
  }
  throw std::invalid_argument(std::string(name) + " has " + std::to_string(view.width) + "x" +
                              std::to_string(view.height) + " px, the image has " +
                              std::to_string(frame.image.width()) + "x" +
                              std::to_string(frame.image.height()));
}

void add_extras(const FrameExtras& extras, CameraFrame& frame) {
  frame.mask = beside(frame, extras.mask, "mask");
  frame.right = beside(frame, extras.right, "right");
  frame.right_mask = beside(frame, extras.right_mask, "right_mask");
  const bool pair = !frame.right.empty();
  if (pair != (extras.baseline_m > 0.0) || !std::isfinite(extras.baseline_m)) {
    throw std::invalid_argument("baseline_m = " + std::to_string(extras.baseline_m) +
                                ", must be above 0 with a right image and 0 without");
  }
  frame.baseline_m = extras.baseline_m;
}

}  // namespace

ImageView view_of(const Pixels& grey) {
  const auto height = static_cast<int>(grey.shape(0)), width = static_cast<int>(grey.shape(1));
  return {grey.data(), width, height, width};
}

Pixels pixels_from(const py::object& image, bool colour, const char* name) {
  require_unmasked(image, name);
  const auto array = py::array::ensure(image);
  const std::string wanted = colour ? "(height, width) grey or (height, width, 3) RGB, uint8"
                                    : "(height, width) grey, uint8";
  if (!array) {
    PyErr_Clear();
    throw std::invalid_argument(std::string(name) + " is no array, must be " + wanted);
  }
  const bool right_shape =
      array.ndim() == 2 || (colour && array.ndim() == 3 && array.shape(2) == 3);
  if (!right_shape || array.size() == 0 || !py::isinstance<py::array_t<std::uint8_t>>(array)) {
    throw std::invalid_argument(std::string(name) + " has shape " + text_of(shape_of(array)) +
                                " of " + py::cast<std::string>(py::str(array.dtype())) +
                                ", must be " + wanted);
  }
  return Pixels(array);
}

void require_time(double time_s) {
  if (!(std::abs(time_s) <= SensorLimits::kLatest)) {
    throw std::invalid_argument("time_s = " + std::to_string(time_s) +
                                ", must be Unix time in seconds");
  }
}

std::shared_ptr<CameraFrame> frame_from(const py::object& image, double time_s,
                                        const PinholeCamera& camera, std::size_t index,
                                        const py::object& T_vehicle_cam,
                                        const FrameExtras& extras) {
  const Pixels pixels = pixels_from(image, false);
  require_time(time_s);
  const auto height = static_cast<int>(pixels.shape(0)), width = static_cast<int>(pixels.shape(1));
  if (camera.is_distorted() || camera.width != width || camera.height != height) {
    throw std::invalid_argument("camera is of " + std::to_string(camera.width) + "x" +
                                std::to_string(camera.height) + " px, the image has " +
                                std::to_string(width) + "x" + std::to_string(height) +
                                "; a frame has no distortion (FrontEnd.feed removes it)");
  }
  auto frame = std::make_shared<CameraFrame>();
  frame->index = index;
  frame->time_s = time_s;
  frame->name = "image " + std::to_string(index);
  frame->image = GreyImage(ImageView{pixels.data(), width, height, width});
  add_extras(extras, *frame);
  frame->camera = camera;
  frame->raw_camera = camera;
  if (!T_vehicle_cam.is_none()) frame->T_vehicle_cam = rigid(T_vehicle_cam, "T_vehicle_cam");
  return frame;
}

}  // namespace oneac::python
