#include "travel.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <vector>

namespace oneac::internal {
namespace {

// [grey/px] a gradient that image noise (below 1 grey after smoothing) places to a third of a px.
constexpr float kLeastGradient = 3.0F;
constexpr float kRest = 0.04F;          // [px of the level] the noise of a flow by such a gradient
constexpr float kLargest = 2.0F;        // [px of the level] beyond it a linearised flow is no flow
constexpr double kClearMajority = 3.0;  // outward over inward, each side by itself
constexpr double kLeastMoving = 0.35;   // of the pixels asked: a standing scene rests
constexpr int kLeastSide = 40;          // [pixels] of one side that move: fewer are one thing
constexpr int kRounds = 3;              // of the common motion, outliers left out
constexpr double kRadial = 0.5;         // least |cos| between gradient and direction of flow

/// A pixel with a gradient: it + gx u + gy v = 0 for its flow (u, v).
struct Asked {
  float gx, gy, it;
  float x, y;            ///< from the direction of travel [px]
  Eigen::Vector3f turn;  ///< g·flow by a rotation about X, Y, Z of the camera [grey/rad]
};

/// Flow of a pixel by a small rotation of the camera X2 = exp([w]x) X1, times its gradient.
Eigen::Vector3f turned(float gx, float gy, float x, float y, float f) {
  const float xy = x * y / f;
  return {-gx * xy - gy * (f + y * y / f), gx * (f + x * x / f) + gy * xy, gy * x - gx * y};
}

/// Derivative by four neighbours, twelve times: that of two is a sixth short where the structure
/// has a period of 6 px, and a flow by it as much too long.
int slope(const std::uint16_t* p, int step) {
  return 8 * (p[step] - p[-step]) - (p[2 * step] - p[-2 * step]);
}

std::vector<Asked> ask(const PyramidLevel& before, const PyramidLevel& now,
                       const TravelView& view) {
  constexpr float kUnit = PyramidLevel::kGreyPerUnit / 24.0F;  // of the sum of two slopes
  const Eigen::Vector2f foe = view.foe.cast<float>(), centre = view.centre.cast<float>();
  const auto focal = static_cast<float>(view.focal);
  std::vector<Asked> asked;
  for (int v = 2; v < std::min(view.end_row, now.height - 2); ++v) {
    const std::uint16_t *a = before.row(v), *b = now.row(v);
    for (int u = 2; u < now.width - 2; ++u) {
      const int dx = slope(a + u, 1) + slope(b + u, 1);
      const int dy = slope(a + u, now.stride) + slope(b + u, now.stride);
      const float gx = kUnit * static_cast<float>(dx), gy = kUnit * static_cast<float>(dy);
      if (gx * gx + gy * gy < kLeastGradient * kLeastGradient) continue;
      const auto x = static_cast<float>(u), y = static_cast<float>(v);
      asked.push_back({gx, gy, PyramidLevel::kGreyPerUnit * static_cast<float>(b[u] - a[u]),
                       x - foe.x(), y - foe.y(),
                       turned(gx, gy, x - centre.x(), y - centre.y(), focal)});
    }
  }
  return asked;
}

/// Rotation that the pixels agree on beside an expansion, largest residuals left out.
Eigen::Vector3f common_turn(const std::vector<Asked>& asked) {
  Eigen::Vector4f flow = Eigen::Vector4f::Zero();
  float bound = kLargest;  // [px] of normal flow
  for (int round = 0; round < kRounds; ++round, bound *= 0.5F) {
    Eigen::Matrix4d N = 1e-6 * Eigen::Matrix4d::Identity();
    Eigen::Vector4d b = Eigen::Vector4d::Zero();
    for (const Asked& a : asked) {
      const Eigen::Vector4f row(a.turn.x(), a.turn.y(), a.turn.z(), a.gx * a.x + a.gy * a.y);
      const float residual = a.it + row.dot(flow);
      const float gg = a.gx * a.gx + a.gy * a.gy;
      if (residual * residual > bound * bound * gg) continue;
      N += (row * (1.0F / gg) * row.transpose()).cast<double>();
      b -= (row * (a.it / gg)).cast<double>();
    }
    flow = N.ldlt().solve(b).cast<float>();
    if (!flow.allFinite()) return Eigen::Vector3f::Zero();
  }
  return flow.head<3>();
}

/// (1 2 1)/4 along a step; the outermost pixels stay.
PyramidLevel smoothed_along(const PyramidLevel& level, bool down) {
  PyramidLevel smooth = level;
  const int step = down ? level.stride : 1;
  for (int v = 1; v < level.height - 1; ++v) {
    const std::uint16_t* p = level.row(v);
    std::uint16_t* q = smooth.row(v);
    for (int u = 1; u < level.width - 1; ++u) {
      q[u] = static_cast<std::uint16_t>((p[u - step] + 2 * p[u] + p[u + step] + 2) / 4);
    }
  }
  return smooth;
}

struct Side {
  int out = 0, in = 0;
};

bool agree(const Side& left, const Side& right) {
  const auto clear = [](int many, int few) {
    return many >= kLeastSide && many >= kClearMajority * few;
  };
  return (clear(left.out, left.in) && clear(right.out, right.in)) ||
         (clear(left.in, left.out) && clear(right.in, right.out));
}

}  // namespace

PyramidLevel smoothed_for_travel(const PyramidLevel& level) {
  return smoothed_along(smoothed_along(level, false), true);
}

Travel shows_travel(const PyramidLevel& before, const PyramidLevel& now, const TravelView& view) {
  const std::vector<Asked> asked = ask(before, now, view);
  if (asked.empty()) return {};
  const Eigen::Vector3f turn = common_turn(asked);
  Side left, right;
  int radial = 0;
  for (const Asked& a : asked) {
    const float away = std::sqrt(a.x * a.x + a.y * a.y) + 1e-3F;
    const float along = (a.gx * a.x + a.gy * a.y) / away;
    if (along * along < kRadial * kRadial * (a.gx * a.gx + a.gy * a.gy)) continue;
    ++radial;
    const float flow = -(a.it + a.turn.dot(turn)) / along;
    if (std::abs(flow) < kRest || std::abs(flow) > kLargest) continue;
    Side& side = a.x < 0.0F ? left : right;
    ++(flow > 0.0F ? side.out : side.in);
  }
  const int moving = left.out + left.in + right.out + right.in;
  return {moving >= kLeastMoving * radial && agree(left, right), -turn.y()};
}

}  // namespace oneac::internal
