#pragma once

#include "oneac/frontend/keyframe.h"
#include "oneac/geometry/camera.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

namespace oneac {

/// Pose graph of the keyframes, as g2o and MRPT's graph-slam read it: VERTEX_SE3:QUAT with the
/// camera in the first camera's frame, EDGE_SE3:QUAT from each keyframe to the next with its
/// information (upper triangle; translation, then the vector part of the quaternion).
[[nodiscard]] std::string format_g2o(const std::vector<Keyframe>& keyframes);
/// Its parts, for what is written piece by piece: every vertex, then from each keyframe to the
/// next.
[[nodiscard]] std::string g2o_vertex_line(const Keyframe& keyframe);
[[nodiscard]] std::string g2o_edge_line(const Keyframe& before, const Keyframe& now);

/// The landmarks as an ASCII PLY: position, normal (zero where unknown), grey as red, green, blue.
/// Written piece by piece: the text of a long drive is larger than all else that is in memory.
void write_ply(const std::vector<Keyframe>& keyframes, std::ostream& out);
/// Its parts: once, with the number of all points, then those of each keyframe.
void write_ply_header(std::size_t points, std::ostream& out);
void write_ply_points(const std::vector<MapPoint>& points, std::ostream& out);

/// Bytes of an mrpt::maps::CSimpleMap, as its loadFromFile() reads them: per keyframe the vehicle's
/// pose with the covariance that the edges add up to, and an image observation with the camera's
/// pose on the vehicle and its calibration, but without pixels.
/// @param T_vehicle_cam  the camera on the vehicle; the first vehicle pose is the identity
[[nodiscard]] std::string format_simple_map(const std::vector<Keyframe>& keyframes,
                                            const Eigen::Isometry3d& T_vehicle_cam,
                                            const PinholeCamera& camera);

/// The same keyframe by keyframe, which MRPT's class would all hold.
class SimpleMapWriter {
 public:
  /// Writes the head to `out`, which outlives this.
  /// @param keyframes  as many will be added
  SimpleMapWriter(const Eigen::Isometry3d& T_vehicle_cam, const PinholeCamera& camera,
                  std::size_t keyframes, std::ostream& out);
  void add(const Keyframe& keyframe);
  /// After the last.
  void finish();

 private:
  Eigen::Isometry3d T_vehicle_cam_;
  PinholeCamera camera_;
  std::ostream& out_;
  std::size_t head_ = 0;  ///< [byte] of a map in front of its first keyframe
  Eigen::Matrix<double, 6, 6> covariance_ = Eigen::Matrix<double, 6, 6>::Zero();  ///< so far
};

}  // namespace oneac
