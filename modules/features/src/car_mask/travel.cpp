#include "travel.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <vector>

namespace oneac::internal {
namespace {

constexpr float kGreyUnit = 1.0F / 16.0F;  // of a pyramid's pixels
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
  float x, y;  ///< from the direction of travel [px]
};

std::vector<Asked> ask(const PyramidLevel& before, const PyramidLevel& now,
                       const Eigen::Vector2d& foe, int end_row) {
  std::vector<Asked> asked;
  for (int v = 1; v < std::min(end_row, now.height - 1); ++v) {
    const std::uint16_t *a = before.row(v), *b = now.row(v);
    const int up = -now.stride, down = now.stride;
    for (int u = 1; u < now.width - 1; ++u) {
      const int dx = a[u + 1] - a[u - 1] + b[u + 1] - b[u - 1];
      const int dy = a[u + down] - a[u + up] + b[u + down] - b[u + up];
      const float gx = 0.25F * kGreyUnit * static_cast<float>(dx);
      const float gy = 0.25F * kGreyUnit * static_cast<float>(dy);
      if (gx * gx + gy * gy < kLeastGradient * kLeastGradient) continue;
      asked.push_back({gx, gy, kGreyUnit * static_cast<float>(b[u] - a[u]),
                       static_cast<float>(u - foe.x()), static_cast<float>(v - foe.y())});
    }
  }
  return asked;
}

/// Flow (shift + expansion · place) that the pixels agree on, largest residuals left out.
Eigen::Vector3d common_flow(const std::vector<Asked>& asked) {
  Eigen::Vector3d flow = Eigen::Vector3d::Zero();
  float bound = kLargest;  // [px] of normal flow
  for (int round = 0; round < kRounds; ++round, bound *= 0.5F) {
    Eigen::Matrix3d N = 1e-6 * Eigen::Matrix3d::Identity();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    for (const Asked& a : asked) {
      const Eigen::Vector3d row(a.gx, a.gy, a.gx * a.x + a.gy * a.y);
      const double residual = a.it + row.dot(flow);
      const double g = std::sqrt(a.gx * a.gx + a.gy * a.gy);
      if (std::abs(residual) > bound * g) continue;
      N += row * row.transpose() / (g * g);
      b -= row * a.it / (g * g);
    }
    flow = N.ldlt().solve(b);
    if (!flow.allFinite()) return Eigen::Vector3d::Zero();
  }
  return flow;
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

bool shows_travel(const PyramidLevel& before, const PyramidLevel& now, const Eigen::Vector2d& foe,
                  int end_row) {
  const std::vector<Asked> asked = ask(before, now, foe, end_row);
  if (asked.empty()) return false;
  const Eigen::Vector3d shift = common_flow(asked);
  Side left, right;
  int radial = 0;
  for (const Asked& a : asked) {
    const float away = std::sqrt(a.x * a.x + a.y * a.y) + 1e-3F;
    const float along = (a.gx * a.x + a.gy * a.y) / away;
    if (along * along < kRadial * kRadial * (a.gx * a.gx + a.gy * a.gy)) continue;
    ++radial;
    const float rest = a.it + static_cast<float>(a.gx * shift.x() + a.gy * shift.y());
    const float flow = -rest / along;
    if (std::abs(flow) < kRest || std::abs(flow) > kLargest) continue;
    Side& side = a.x < 0.0F ? left : right;
    ++(flow > 0.0F ? side.out : side.in);
  }
  const int moving = left.out + left.in + right.out + right.in;
  return moving >= kLeastMoving * radial && agree(left, right);
}

}  // namespace oneac::internal
