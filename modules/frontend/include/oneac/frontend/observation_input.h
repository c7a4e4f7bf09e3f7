#pragma once

#include "oneac/geometry/camera_frame.h"

#include <Eigen/Core>

#include <optional>
#include <string>

namespace mrpt::obs {
class CObservation;
}

namespace oneac {

/// The frame of an image observation, or of the left camera of a stereo one (with the right image
/// when the pair is rectified): grey, undistorted,
/// sensor pose in optical or x-forward axes told apart as in docs/formats.md. Empty for any other
/// class and for an image that cannot be loaded. `index` is left 0.
/// @throws InputError without a calibration or with a lens model that is not plumb-bob
[[nodiscard]] std::optional<CameraFrame> frame_from_observation(
    const mrpt::obs::CObservation& observation);

/// Specific force in the vehicle frame [m/s²]; empty when it is no IMU or has no accelerometer.
[[nodiscard]] std::optional<Eigen::Vector3d> acceleration_from_observation(
    const mrpt::obs::CObservation& observation);

/// Angular rate about the vehicle's Z axis [rad/s]; empty when it is no IMU or has no gyroscopes.
[[nodiscard]] std::optional<double> yaw_rate_from_observation(
    const mrpt::obs::CObservation& observation);

/// Speed over ground [m/s] of a GPS observation with a valid RMC message.
[[nodiscard]] std::optional<double> speed_from_observation(
    const mrpt::obs::CObservation& observation);

}  // namespace oneac
