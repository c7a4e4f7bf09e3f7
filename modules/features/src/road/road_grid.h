#pragma once

#include "patch/image_pyramid.h"

#include "oneac/base/workers.h"
#include "oneac/features/road_alignment.h"

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace oneac::internal {

constexpr int kLanes = 5;  // blocks across the strip: a car takes two
constexpr int kBands = 3;  // blocks along it
constexpr int kBlocks = kLanes * kBands;
constexpr int kColumns = 16;  // lines along the road in a block
constexpr int kRows = 24;     // places on such a line, at equal steps in the image
constexpr int kPerBlock = kColumns * kRows;

/// Motion and road between the template view a and the view b that is aligned with it.
struct RoadMotion {
  Eigen::Matrix3d R_b_a = Eigen::Matrix3d::Identity();
  Eigen::Vector3d s = Eigen::Vector3d::UnitZ();  ///< direction to b's origin … from a, in b
  Eigen::Vector3d n = Eigen::Vector3d::UnitY();  ///< normal of the road in b
  double length = 0.0;                           ///< [heights]
};

/// Where samples of the road are looked up, and under which conditions.
struct RoadContext {
  const ImagePyramid* template_image = nullptr;  ///< view a
  const ImagePyramid* image = nullptr;           ///< view b
  PinholeCamera camera;
  ImageView mask;
  Workers* workers = nullptr;  ///< who share the work
};

/// Samples of the road, block by block, line by line.
struct RoadGrid {
  std::vector<Eigen::Vector3d> rays;       ///< in a, kPerBlock per block
  std::vector<Eigen::Vector2d> u;          ///< [px] in a
  std::vector<char> usable;                ///< inside a and not masked
  std::array<double, kBlocks> distance{};  ///< [heights] of a block's middle
  double nearest = 0.0;                    ///< [heights] of all of it
  double usable_share = 0.0;
};

/// The strip of road as the view a sees it.
[[nodiscard]] RoadGrid make_road_grid(const RoadContext& context, const Eigen::Matrix3d& R_level_a,
                                      const RoadAlignmentOptions& options);

/// Grey value with gradient at pixel coordinates of the level; false outside.
struct GreySample {
  float grey, du, dv;
};

/// [grey levels] per unit of the pyramid's pixels.
constexpr float kGreyPerUnit = 1.0F / PyramidLevel::kPerGrey;

inline bool inside_level(const PyramidLevel& level, double u, double v) {
  return u >= 0.0 && v >= 0.0 && u < level.width - 1 && v < level.height - 1;
}

/// Bilinear. @pre inside_level
inline float grey_at(const PyramidLevel& level, float u, float v) {
  const int u0 = static_cast<int>(u), v0 = static_cast<int>(v);
  const float a = u - static_cast<float>(u0), b = v - static_cast<float>(v0);
  const std::uint16_t* p = level.pixels.data() + level.index(u0, v0);
  const float p00 = p[0], p10 = p[1], p01 = p[level.stride], p11 = p[level.stride + 1];
  const float top = p00 + a * (p10 - p00), bottom = p01 + a * (p11 - p01);
  return kGreyPerUnit * (top + b * (bottom - top));
}

/// Bilinear with the gradient over two pixels, [grey/px of the level]. @pre inside_level
inline GreySample sample_at(const PyramidLevel& level, float u, float v) {
  GreySample s{};
  s.grey = grey_at(level, u, v);
  s.du = 0.5F * (grey_at(level, u + 1.0F, v) - grey_at(level, u - 1.0F, v));
  s.dv = 0.5F * (grey_at(level, u, v + 1.0F) - grey_at(level, u, v - 1.0F));
  return s;
}

/// Is the pixel of the full image not masked?
[[nodiscard]] inline bool unmasked(const ImageView& mask, double u, double v) {
  if (mask.empty()) return true;
  const int column = static_cast<int>(std::floor(u + 0.5)),
            row = static_cast<int>(std::floor(v + 0.5));
  return mask.data[static_cast<std::ptrdiff_t>(row) * mask.stride + column] >= 128;
}

/// Grey values of the template at a level, NaN-free; samples that are not usable are 0.
[[nodiscard]] std::vector<float> template_values(const RoadContext& context, const RoadGrid& grid,
                                                 std::size_t level);
/// The same with gradients.
[[nodiscard]] std::vector<GreySample> template_samples(const RoadContext& context,
                                                       const RoadGrid& grid, std::size_t level);

/// How the blocks are looked at.
template <class Sample>
struct RoadLook {
  std::size_t level = 0;       ///< of the pyramids
  std::vector<Sample> values;  ///< of the template there: template_values(), template_samples()
  double noise_grey = 0.0;     ///< [grey] 1σ of a pixel of that level
  int stride = 1;              ///< every so many-th line along the road is used
};

}  // namespace oneac::internal
