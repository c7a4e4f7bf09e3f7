#pragma once

#include "street_layout.h"

#include "oneac/geometry/camera.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace oneac::simulation {

/// The rays of a camera in world axes. The ray of pixel (u, v) is affine in u and v, its third
/// component in camera axes is 1: a hit at inverse depth w lies at centre + ray / w.
struct RayFan {
  RayFan(const PinholeCamera& camera, const Eigen::Isometry3d& T_world_cam);

  [[nodiscard]] Eigen::Vector3d ray(double u, double v) const { return origin + u * du + v * dv; }
  /// The same with row v as its first.
  [[nodiscard]] RayFan from_row(int v) const {
    RayFan fan = *this;
    fan.origin += v * dv;
    return fan;
  }

  Eigen::Vector3d centre;
  Eigen::Vector3d origin;  ///< ray of pixel (0, 0)
  Eigen::Vector3d du;      ///< change of the ray per pixel to the right
  Eigen::Vector3d dv;      ///< change of the ray per pixel down
};

/// A rectangle across one axis of the world: axis·X = offset, bounded along the next two axes
/// (cyclic: (axis + 1) % 3, (axis + 2) % 3).
struct Face {
  int axis = 2;
  double offset = 0.0;
  Eigen::Vector2d low;
  Eigen::Vector2d high;
  int box = -1;        ///< index of the box that it belongs to; -1: the ground
  bool upper = false;  ///< of the box's two sides across the axis

  [[nodiscard]] int first() const { return (axis + 1) % 3; }
  [[nodiscard]] int second() const { return (axis + 2) % 3; }
  /// Inverse depth of the face's plane along a ray; not positive: behind the camera.
  [[nodiscard]] double inverse_depth(const RayFan& fan, const Eigen::Vector3d& ray) const {
    return ray[axis] / (offset - fan.centre[axis]);
  }
};

/// Between facades, boxes farther away are hidden by nearer ones or tiny [m].
inline constexpr double kViewInTown_m = 180.0;
inline constexpr double kViewInTheOpen_m = 450.0;

/// The ground, and the sides of the boxes that are turned towards the centre and near enough.
[[nodiscard]] std::vector<Face> faces_towards(const std::vector<Box>& boxes,
                                              const Eigen::Vector3d& centre, double range_m);

/// Farther than this is sky [m].
inline constexpr double kFarthest_m = 1000.0;

/// Which face each sample of a grid shows: nearest first, exact at the samples.
class FaceRasteriser {
 public:
  static constexpr std::uint16_t kSky = 0xffff;
  static constexpr int kPerSide = 2;  ///< samples per pixel and axis, for smooth silhouettes

  FaceRasteriser(const RayFan& fan, const std::vector<Face>& faces, int width, int height);

  /// Index of the face at sample (i, j), or kSky.
  [[nodiscard]] std::uint16_t face(int i, int j) const { return ids_[index(i, j)]; }
  /// Pixel coordinate of a sample.
  [[nodiscard]] static double pixel(int i) { return (i + 0.5) / kPerSide - 0.5; }

 private:
  void draw(const RayFan& fan, const Face& face, std::uint16_t id);
  [[nodiscard]] std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(i);
  }

  int columns_;
  int rows_;
  std::vector<std::uint16_t> ids_;
  std::vector<float> inverse_depths_;
};

}  // namespace oneac::simulation
