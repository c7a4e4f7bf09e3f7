#pragma once

#include "crossing_traffic.h"
#include "shader.h"

#include "oneac/base/image.h"
#include "oneac/geometry/camera.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <optional>
#include <vector>

namespace oneac::simulation {

/// Renders the town: visibility at 2×2 samples per pixel, one filtered look at each surface that a
/// pixel shows.
class StreetRenderer {
 public:
  StreetRenderer(const PinholeCamera& camera, const Route& route, std::uint64_t seed,
                 std::vector<CrossingVehicle> traffic);

  /// Grey levels at a time of the drive [s], row by row.
  [[nodiscard]] std::vector<float> render(const Eigen::Isometry3d& T_world_cam,
                                          double time_s) const;
  [[nodiscard]] std::optional<Eigen::Vector3d> surface_point(const Eigen::Isometry3d& T_world_cam,
                                                             const Eigen::Vector2d& u_px,
                                                             double time_s) const;

 private:
  [[nodiscard]] std::vector<Box> boxes_at(double time_s) const;

  PinholeCamera camera_;
  std::vector<CrossingVehicle> traffic_;
  std::vector<Box> boxes_;  ///< what stands, then the traffic where it starts
  Shader shader_;
};

/// Rounds to 8 bits after adding Gaussian noise that depends on nothing but the key.
[[nodiscard]] GreyImage expose(const std::vector<float>& grey, int width, int height, double sigma,
                               std::uint64_t key);

}  // namespace oneac::simulation
