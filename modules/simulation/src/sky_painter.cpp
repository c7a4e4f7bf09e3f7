#include "sky_painter.h"

namespace oneac::simulation {
namespace {

constexpr double kCloudTexel = 12.0;  // [m] some pixels: clouds have no sharp edges
constexpr int kCloudSide = 1024;

}  // namespace

Texture paint_clouds(std::uint64_t seed) {
  RandomNumbers random(seed ^ 0x636c6f7564ULL);
  Canvas canvas(kCloudSide, kCloudSide, 185.0F);
  canvas.dead_leaves(random, {2.0, 80.0, 0.5, 15.0, 0.0});
  return {canvas, kCloudTexel};
}

}  // namespace oneac::simulation
