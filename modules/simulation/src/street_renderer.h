#pragma once

#include "crossing_traffic.h"
#include "shader.h"

#include "oneac/base/image.h"
#include "oneac/geometry/camera.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace oneac::simulation {

/// Renders the town: visibility at 2×2 samples per pixel, one filtered look at each surface that a
/// pixel shows.
class StreetRenderer {
 public:
  /// @param relit  the same town in another light and with other parked vehicles
  StreetRenderer(const PinholeCamera& camera, const Route& route, const SimulationOptions& options,
                 std::vector<MovingVehicle> traffic, bool relit);

  /// Grey levels at a time of the drive [s], row by row.
  [[nodiscard]] std::vector<float> render(const Eigen::Isometry3d& T_world_cam,
                                          double time_s) const;
  using PoseAt = std::function<Eigen::Isometry3d(double time_s)>;
  /// The same by a rolling shutter: the first row at time_s, the last shutter_s later.
  [[nodiscard]] std::vector<float> render_rolling(const PoseAt& T_world_cam, double time_s,
                                                  double shutter_s) const;
  [[nodiscard]] std::optional<Eigen::Vector3d> surface_point(const Eigen::Isometry3d& T_world_cam,
                                                             const Eigen::Vector2d& u_px,
                                                             double time_s) const;

 private:
  [[nodiscard]] std::vector<Box> boxes_at(double time_s) const;
  void render_rows(const RayFan& fan, double time_s, int rows, std::vector<float>& grey) const;

  PinholeCamera camera_;
  double view_range_m_;
  std::vector<MovingVehicle> traffic_;
  std::vector<Box> boxes_;  ///< what stands, then the traffic where it starts
  Shader shader_;
};

/// Rounds to 8 bits after adding Gaussian noise that depends on nothing but the key.
[[nodiscard]] GreyImage expose(const std::vector<float>& grey, int width, int height, double sigma,
                               std::uint64_t key);

}  // namespace oneac::simulation
