#pragma once

#include "face_rasteriser.h"
#include "road_painter.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace oneac::simulation {

/// What every surface of the town looks like.
class Shader {
 public:
  /// @param relit  with the sun in the north-east and other parked vehicles
  Shader(const Route& route, const std::vector<Box>& boxes, const SimulationOptions& options,
         bool relit);

  /// Grey level of a face at a pixel, averaged over the pixel. @pre the face is in front there
  /// @param boxes  as they stand now: the ones given, moved
  [[nodiscard]] float face(const RayFan& fan, const Face& face, const std::vector<Box>& boxes,
                           double u, double v) const;
  /// The same of the ground where it is wet: the share of the light from above that it mirrors,
  /// [0, 1]; 0 of a dry road. @pre the ground is in front there
  [[nodiscard]] float mirrored(const RayFan& fan, double u, double v) const;
  [[nodiscard]] bool mirrors() const { return puddles_.has_value(); }
  /// The same of the sky: plain, or clouds.
  [[nodiscard]] float sky(const RayFan& fan, double u, double v) const;

 private:
  [[nodiscard]] float ground(const Footprint& patch) const;
  [[nodiscard]] float wall(const Face& face, const Box& box, const Footprint& patch) const;

  bool relit_;
  std::vector<Leg> legs_;
  std::vector<RoadDecal> decals_;
  std::vector<Texture> box_textures_;
  Texture asphalt_;
  Texture tone_;
  std::optional<Texture> clouds_;
  std::optional<Texture> puddles_;
};

}  // namespace oneac::simulation
