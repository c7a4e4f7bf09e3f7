#include "oneac/robust/point_set.h"

#include "oneac/geometry/essential.h"

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

// Points scored between two looks at `give_up`: long enough for the vector units, short enough to
// drop a bad hypothesis after a fraction of the points.
constexpr std::size_t kBlock = 64;

struct FloatE {
  float e[9];
};

FloatE to_float(const Eigen::Matrix3d& E) {
  FloatE f{};
  for (int i = 0; i < 9; ++i) f.e[i] = static_cast<float>(E(i / 3, i % 3));
  return f;
}

/// Σ min(r² / threshold², 1) over [begin, end).
float block_cost(const FloatE& m, const PointSet& p, std::size_t begin, std::size_t end,
                 float inverse_squared_threshold) {
  const float* e = m.e;
  float sum = 0.0F;
  float partial[8] = {};
  const std::size_t even_end = begin + (end - begin) / 8 * 8;
  const auto term = [&](std::size_t i) {
    const float x1 = p.x1[i], y1 = p.y1[i], x2 = p.x2[i], y2 = p.y2[i];
    const float a = e[0] * x1 + e[1] * y1 + e[2];
    const float b = e[3] * x1 + e[4] * y1 + e[5];
    const float c = e[6] * x1 + e[7] * y1 + e[8];
    const float d = e[0] * x2 + e[3] * y2 + e[6];
    const float f = e[1] * x2 + e[4] * y2 + e[7];
    const float algebraic = x2 * a + y2 * b + c;
    const float gradient = a * a + b * b + d * d + f * f + 1e-30F;
    const float ratio = algebraic * algebraic * inverse_squared_threshold / gradient;
    return ratio < 1.0F ? ratio : 1.0F;
  };
  for (std::size_t i = begin; i < even_end; i += 8) {
    for (std::size_t lane = 0; lane < 8; ++lane) partial[lane] += term(i + lane);
  }
  for (std::size_t i = even_end; i < end; ++i) sum += term(i);
  for (float lane : partial) sum += lane;
  return sum;
}

}  // namespace

PointSet::PointSet(AcSpan acs) {
  for (std::vector<float>* v : {&x1, &y1, &x2, &y2}) v->reserve(acs.size());
  for (const AffineCorrespondence& ac : acs) {
    x1.push_back(static_cast<float>(ac.x1.x()));
    y1.push_back(static_cast<float>(ac.x1.y()));
    x2.push_back(static_cast<float>(ac.x2.x()));
    y2.push_back(static_cast<float>(ac.x2.y()));
  }
}

double msac_cost(const Eigen::Matrix3d& E, const PointSet& points, double threshold,
                 double give_up) {
  const FloatE e = to_float(E);
  const auto inverse_squared = static_cast<float>(1.0 / (threshold * threshold));
  double cost = 0.0;
  for (std::size_t begin = 0; begin < points.size() && cost < give_up; begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, points.size());
    cost += static_cast<double>(block_cost(e, points, begin, end, inverse_squared));
  }
  return cost;
}

std::vector<bool> sampson_inliers(const Eigen::Matrix3d& E, AcSpan acs, double threshold) {
  std::vector<bool> inliers(acs.size());
  for (std::size_t i = 0; i < acs.size(); ++i) {
    inliers[i] = std::abs(sampson_distance(E, acs[i].x1, acs[i].x2)) <= threshold;
  }
  return inliers;
}

}  // namespace oneac
