#include "front_end_records.h"

#include <mrpt/core/Clock.h>
#include <pybind11/stl.h>

#include <algorithm>

namespace oneac::python {
namespace {

py::object to_python(const StepResult& step) {
  return result_class("Step")(step.index1, step.index2, step.time1, step.time2,
                              to_string(step.status), to_numpy(Eigen::MatrixXd(step.pose.R)),
                              to_numpy(step.pose.t), step.metric, step.length, step.length_sigma,
                              to_numpy(Eigen::MatrixXd(step.covariance)), step.acs, step.inliers,
                              step.segment);
}

}  // namespace

py::object to_python(const FrameResult& result) {
  const py::object step = result.step ? to_python(*result.step) : py::object(py::none());
  const py::object keyframe = py::cast(result.keyframe);
  return result_class("FrameResult")(result.index, result.time_s, to_numpy(result.T_first_cam),
                                     to_numpy(result.T_odom_cam), step, result.tilt.tilt.pitch_up,
                                     result.tilt.tilt.roll_right, keyframe);
}

py::object to_python(const TiltBelief& belief) {
  return result_class("TiltBelief")(belief.tilt.pitch_up, belief.tilt.roll_right,
                                    belief.pitch_sigma, belief.roll_sigma);
}

py::object to_python(const CameraBelief& belief) {
  return result_class("CameraBelief")(
      belief.given, belief.used, belief.raw_used, belief.raw_learned,
      to_numpy(Eigen::MatrixXd(belief.sigma.transpose())).attr("ravel")(), belief.focal_px,
      belief.focal_sigma, belief.drive_sigma, belief.bends, belief.sensors, belief.contradicting,
      belief.doubt, belief.knows_focal());
}

void log_to_python(std::string_view text, mrpt::system::VerbosityLevel level) {
  const py::gil_scoped_acquire acquire;
  const int levels[] = {10, 20, 30, 40};  // DEBUG, INFO, WARN, ERROR of both
  const int number = levels[std::clamp(static_cast<int>(level), 0, 3)];
  const std::string line(text.substr(0, text.find_last_not_of("\r\n") + 1));
  py::module_::import("logging").attr("getLogger")("oneac").attr("log")(number, "%s", line);
}

std::shared_ptr<mrpt::obs::CObservationImage> observation_of(const Pixels& pixels, double time_s,
                                                             const Eigen::Isometry3d& mount) {
  const auto height = static_cast<int>(pixels.shape(0)), width = static_cast<int>(pixels.shape(1));
  const bool grey = pixels.ndim() == 2;
  auto observation = mrpt::obs::CObservationImage::Create();
  observation->sensorLabel = "numpy";
  observation->timestamp = mrpt::Clock::fromDouble(time_s);
  observation->cameraPose = mrpt::poses::CPose3D(mrpt::math::CMatrixDouble44(mount.matrix()));
  mrpt::img::CImage image(static_cast<unsigned>(width), static_cast<unsigned>(height),
                          grey ? mrpt::img::CH_GRAY : mrpt::img::CH_RGB);
  for (int v = 0; v < height; ++v) {
    auto* row = image.ptrLine<std::uint8_t>(static_cast<unsigned>(v));
    const std::uint8_t* from = pixels.data() + static_cast<py::ssize_t>(v) * width * (grey ? 1 : 3);
    if (grey) {
      std::copy_n(from, width, row);
    } else {  // blue first in memory
      for (std::ptrdiff_t u = 0; u < width; ++u)
        std::reverse_copy(from + 3 * u, from + 3 * u + 3, row + 3 * u);
    }
  }
  observation->image = std::move(image);
  return observation;
}

}  // namespace oneac::python
