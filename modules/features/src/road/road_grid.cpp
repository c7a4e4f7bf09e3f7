#include "road_grid.h"

#include <algorithm>
#include <cmath>

namespace oneac::internal {
namespace {

constexpr int kScan = 200;         // steps of the search for the nearest road in view
constexpr double kReach = 2.5;     // farthest over nearest: farther rows tell little beside these
constexpr double kLeastReach = 8;  // [heights] but as far as this
// [px] from the border: the kernel of the gradient at the coarsest level.
constexpr double kMargin = 8.0;

bool in_view(const RoadContext& context, const Eigen::Vector3d& ray, Eigen::Vector2d& u) {
  if (!(ray.z() > 1e-3)) return false;
  u = context.camera.project({ray.x() / ray.z(), ray.y() / ray.z()});
  return u.x() >= kMargin && u.y() >= kMargin && u.x() < context.camera.width - 1 - kMargin &&
         u.y() < context.camera.height - 1 - kMargin && unmasked(context.mask, u.x(), u.y());
}

/// [heights] of the nearest road in the middle of the strip that is in view; 0: none.
double nearest_in_view(const RoadContext& context, const Eigen::Matrix3d& R_a_level,
                       const RoadAlignmentOptions& options) {
  Eigen::Vector2d u;
  for (int i = 0; i < kScan; ++i) {
    const double share = static_cast<double>(i) / kScan;
    const double z = options.nearest * std::pow(options.farthest / options.nearest, share);
    if (in_view(context, R_a_level * Eigen::Vector3d(0.0, 1.0, z), u)) return z;
  }
  return 0.0;
}

/// What the template shows at every usable sample of the grid, read by `read`, which needs `margin`
/// pixels around a place; zero elsewhere.
template <class Sample, class Read>
std::vector<Sample> look_up(const RoadContext& context, const RoadGrid& grid, std::size_t level,
                            double margin, const Read& read) {
  const PyramidLevel& pixels = context.template_image->levels[level];
  const double scale = 1.0 / static_cast<double>(1U << level);
  std::vector<Sample> samples(grid.rays.size(), Sample{});
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!grid.usable[i]) continue;
    const Eigen::Vector2d u = scale * grid.u[i];
    if (!inside_level(pixels, u.x() - margin, u.y() - margin)) continue;
    if (!inside_level(pixels, u.x() + margin, u.y() + margin)) continue;
    samples[i] = read(pixels, static_cast<float>(u.x()), static_cast<float>(u.y()));
  }
  return samples;
}

}  // namespace

RoadGrid make_road_grid(const RoadContext& context, const Eigen::Matrix3d& R_level_a,
                        const RoadAlignmentOptions& options) {
  RoadGrid grid;
  const Eigen::Matrix3d R_a_level = R_level_a.transpose();
  grid.nearest = nearest_in_view(context, R_a_level, options);
  if (!(grid.nearest > 0.0)) return grid;
  const double farthest = std::min(options.farthest, std::max(kLeastReach, kReach * grid.nearest));
  const double low = 1.0 / farthest, high = 1.0 / grid.nearest;
  std::size_t usable = 0;
  for (int block = 0; block < kBlocks; ++block) {
    const int lane = block % kLanes, band = block / kLanes;
    grid.distance[static_cast<std::size_t>(block)] =
        1.0 / (high - (high - low) * (band + 0.5) / kBands);
    for (int i = 0; i < kPerBlock; ++i) {
      const int column = i / kRows, row = i % kRows;
      const double across = (lane + (column + 0.5) / kColumns) / kLanes;
      const double along = (band + (row + 0.5) / kRows) / kBands;
      const double x = options.half_width * (2.0 * across - 1.0);
      const double z = 1.0 / (high - (high - low) * along);
      const Eigen::Vector3d ray = R_a_level * Eigen::Vector3d(x, 1.0, z);
      Eigen::Vector2d u = Eigen::Vector2d::Zero();
      const bool seen = in_view(context, ray, u);
      usable += seen ? 1 : 0;
      grid.rays.push_back(ray);
      grid.u.push_back(u);
      grid.usable.push_back(seen ? 1 : 0);
    }
  }
  grid.usable_share = static_cast<double>(usable) / (kBlocks * kPerBlock);
  return grid;
}

std::vector<float> template_values(const RoadContext& context, const RoadGrid& grid,
                                   std::size_t level) {
  return look_up<float>(context, grid, level, 0.0, grey_at);
}

std::vector<GreySample> template_samples(const RoadContext& context, const RoadGrid& grid,
                                         std::size_t level) {
  return look_up<GreySample>(context, grid, level, 1.0, sample_at);
}

}  // namespace oneac::internal
