#include "consensus/levelled_acs.h"

#include <algorithm>

namespace oneac::internal {

namespace {

/// A point seen by a camera turned by Q, and the derivative of its new place by the old one.
struct Turned {
  double u, v, ux, uy, vx, vy, depth;

  Turned(const Eigen::Matrix3d& Q, double x, double y)
      : depth(Q(2, 0) * x + Q(2, 1) * y + Q(2, 2)) {
    const double inverse = 1.0 / depth;
    u = (Q(0, 0) * x + Q(0, 1) * y + Q(0, 2)) * inverse;
    v = (Q(1, 0) * x + Q(1, 1) * y + Q(1, 2)) * inverse;
    ux = (Q(0, 0) - u * Q(2, 0)) * inverse;
    uy = (Q(0, 1) - u * Q(2, 1)) * inverse;
    vx = (Q(1, 0) - v * Q(2, 0)) * inverse;
    vy = (Q(1, 1) - v * Q(2, 1)) * inverse;
  }
};

// Smallest depth of a point in front of the turned camera, as in geometry's rotate_views.
constexpr double kInFront = 1e-6;

}  // namespace

LevelledAcs::LevelledAcs(AcSpan acs, const Eigen::Matrix3d& R_level_cam) {
  for (auto& entries : level_) entries.resize(acs.size());
  for (const AffineCorrespondence& ac : acs) {
    const Turned a(R_level_cam, ac.x1.x(), ac.x1.y());
    const Turned b(R_level_cam, ac.x2.x(), ac.x2.y());
    const double det = a.ux * a.vy - a.uy * a.vx;
    if (!(a.depth > kInFront && b.depth > kInFront && det > 0.0)) continue;
    // A' = B A C⁻¹ with the derivatives B and C of the second and the first view.
    const double c11 = ac.A(0, 0) * a.vy - ac.A(0, 1) * a.vx;
    const double c12 = ac.A(0, 1) * a.ux - ac.A(0, 0) * a.uy;
    const double c21 = ac.A(1, 0) * a.vy - ac.A(1, 1) * a.vx;
    const double c22 = ac.A(1, 1) * a.ux - ac.A(1, 0) * a.uy;
    const double inverse = 1.0 / det;
    const double entries[8] = {a.u,
                               a.v,
                               b.u,
                               b.v,
                               (b.ux * c11 + b.uy * c21) * inverse,
                               (b.ux * c12 + b.uy * c22) * inverse,
                               (b.vx * c11 + b.vy * c21) * inverse,
                               (b.vx * c12 + b.vy * c22) * inverse};
    for (std::size_t k = 0; k < 8; ++k) level_[k][size_] = entries[k];
    ++size_;
  }
}

void LevelledAcs::turn_second_view(const Eigen::Matrix3d& Q, const Stride& share) {
  const std::size_t count = size_ > share.first ? (size_ - share.first - 1) / share.step + 1 : 0;
  for (auto& entries : turned_) entries.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = share.first + k * share.step;
    const Turned t(Q, level_[kX2][i], level_[kY2][i]);
    turned_[kX1][k] = level_[kX1][i];
    turned_[kY1][k] = level_[kY1][i];
    turned_[kX2][k] = t.u;
    turned_[kY2][k] = t.v;
    turned_[kA11][k] = t.ux * level_[kA11][i] + t.uy * level_[kA21][i];
    turned_[kA12][k] = t.ux * level_[kA12][i] + t.uy * level_[kA22][i];
    turned_[kA21][k] = t.vx * level_[kA11][i] + t.vy * level_[kA21][i];
    turned_[kA22][k] = t.vx * level_[kA12][i] + t.vy * level_[kA22][i];
  }
}

AcArrays LevelledAcs::arrays() const {
  return {turned_[kX1].data(),  turned_[kY1].data(),  turned_[kX2].data(),
          turned_[kY2].data(),  turned_[kA11].data(), turned_[kA12].data(),
          turned_[kA21].data(), turned_[kA22].data(), turned_[kX1].size()};
}

AffineCorrespondence LevelledAcs::at(std::size_t i) const {
  AffineCorrespondence ac;
  ac.x1 << turned_[kX1][i], turned_[kY1][i];
  ac.x2 << turned_[kX2][i], turned_[kY2][i];
  ac.A << turned_[kA11][i], turned_[kA12][i], turned_[kA21][i], turned_[kA22][i];
  return ac;
}

PointArrays<float> LevelledAcs::sample(std::size_t count, const Eigen::Matrix3d& Q) {
  const std::size_t used = std::min(count, size_);
  const std::size_t padded = (used + kPointGroup - 1) / kPointGroup * kPointGroup;
  for (auto& column : sample_) column.assign(padded, 0.0F);
  for (std::size_t k = 0; k < used; ++k) {
    const std::size_t i = k * size_ / used;
    const Turned t(Q, level_[kX2][i], level_[kY2][i]);
    sample_[0][k] = static_cast<float>(level_[kX1][i]);
    sample_[1][k] = static_cast<float>(level_[kY1][i]);
    sample_[2][k] = static_cast<float>(t.u);
    sample_[3][k] = static_cast<float>(t.v);
    sample_[4][k] = 1.0F;
  }
  return {sample_[0].data(), sample_[1].data(), sample_[2].data(),
          sample_[3].data(), sample_[4].data(), padded};
}

}  // namespace oneac::internal
