#pragma once

#include "oneac/frontend/keyframe.h"
#include "oneac/geometry/camera.h"

#include <Eigen/Geometry>

#include <iosfwd>
#include <string>
#include <vector>

namespace oneac {

/// Pose graph of the keyframes, as g2o and MRPT's graph-slam read it: VERTEX_SE3:QUAT with the
/// camera in the first camera's frame, EDGE_SE3:QUAT from each keyframe to the next with its
/// information (upper triangle; translation, then the vector part of the quaternion).
[[nodiscard]] std::string format_g2o(const std::vector<Keyframe>& keyframes);

/// The landmarks as an ASCII PLY: position, normal (zero where unknown), grey as red, green, blue.
/// Written piece by piece: the text of a long drive is larger than all else that is in memory.
void write_ply(const std::vector<Keyframe>& keyframes, std::ostream& out);

/// Bytes of an mrpt::maps::CSimpleMap, as its loadFromFile() reads them: per keyframe the vehicle's
/// pose with the covariance that the edges add up to, and an image observation with the camera's
/// pose on the vehicle and its calibration, but without pixels.
/// @param T_vehicle_cam  the camera on the vehicle; the first vehicle pose is the identity
[[nodiscard]] std::string format_simple_map(const std::vector<Keyframe>& keyframes,
                                            const Eigen::Isometry3d& T_vehicle_cam,
                                            const PinholeCamera& camera);

}  // namespace oneac
