#pragma once

#include "frames.h"
#include "records.h"

#include "oneac/frontend/camera_belief.h"
#include "oneac/frontend/frame_result.h"
#include "oneac/frontend/tilt_belief.h"

#include <mrpt/obs/CObservationImage.h>
#include <mrpt/system/COutputLogger.h>

#include <memory>
#include <string_view>

namespace oneac::python {

/// oneac.FrameResult.
[[nodiscard]] py::object to_python(const FrameResult& result);
/// oneac.TiltBelief and oneac.CameraBelief.
[[nodiscard]] py::object to_python(const TiltBelief& belief);
[[nodiscard]] py::object to_python(const CameraBelief& belief);
/// A line of MRPT's logger to Python's, "oneac". Takes the interpreter's lock.
void log_to_python(std::string_view text, mrpt::system::VerbosityLevel level);
/// The observation of an image as the front-end's feed() takes it.
[[nodiscard]] std::shared_ptr<mrpt::obs::CObservationImage> observation_of(
    const Pixels& pixels, double time_s, const Eigen::Isometry3d& mount);

}  // namespace oneac::python
