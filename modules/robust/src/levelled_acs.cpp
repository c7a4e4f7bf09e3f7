#include "levelled_acs.h"

#include "oneac/geometry/homography.h"

#include <algorithm>

namespace oneac::internal {

LevelledAcs::LevelledAcs(AcSpan acs, const Eigen::Matrix3d& R_level_cam) {
  for (auto& entries : level_) entries.reserve(acs.size());
  for (const AffineCorrespondence& tilted : acs) {
    const auto ac = rotate_views(tilted, R_level_cam, R_level_cam);
    if (!ac) continue;
    const double entries[8] = {ac->x1.x(),  ac->x1.y(),  ac->x2.x(),  ac->x2.y(),
                               ac->A(0, 0), ac->A(0, 1), ac->A(1, 0), ac->A(1, 1)};
    for (std::size_t k = 0; k < 8; ++k) level_[k].push_back(entries[k]);
    ++size_;
  }
}

void LevelledAcs::turn_second_view(const Eigen::Matrix3d& Q, const Stride& share) {
  const std::size_t count = size_ > share.first ? (size_ - share.first - 1) / share.step + 1 : 0;
  for (auto& entries : turned_) entries.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = share.first + k * share.step;
    const double x = level_[kX2][i];
    const double y = level_[kY2][i];
    const double inverse = 1.0 / (Q(2, 0) * x + Q(2, 1) * y + Q(2, 2));
    const double u = (Q(0, 0) * x + Q(0, 1) * y + Q(0, 2)) * inverse;
    const double v = (Q(1, 0) * x + Q(1, 1) * y + Q(1, 2)) * inverse;
    // Derivative of (u, v) with respect to (x, y).
    const double ux = (Q(0, 0) - u * Q(2, 0)) * inverse;
    const double uy = (Q(0, 1) - u * Q(2, 1)) * inverse;
    const double vx = (Q(1, 0) - v * Q(2, 0)) * inverse;
    const double vy = (Q(1, 1) - v * Q(2, 1)) * inverse;
    turned_[kX1][k] = level_[kX1][i];
    turned_[kY1][k] = level_[kY1][i];
    turned_[kX2][k] = u;
    turned_[kY2][k] = v;
    turned_[kA11][k] = ux * level_[kA11][i] + uy * level_[kA21][i];
    turned_[kA12][k] = ux * level_[kA12][i] + uy * level_[kA22][i];
    turned_[kA21][k] = vx * level_[kA11][i] + vy * level_[kA21][i];
    turned_[kA22][k] = vx * level_[kA12][i] + vy * level_[kA22][i];
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
    const double x = level_[kX2][i];
    const double y = level_[kY2][i];
    const double inverse = 1.0 / (Q(2, 0) * x + Q(2, 1) * y + Q(2, 2));
    sample_[0][k] = static_cast<float>(level_[kX1][i]);
    sample_[1][k] = static_cast<float>(level_[kY1][i]);
    sample_[2][k] = static_cast<float>((Q(0, 0) * x + Q(0, 1) * y + Q(0, 2)) * inverse);
    sample_[3][k] = static_cast<float>((Q(1, 0) * x + Q(1, 1) * y + Q(1, 2)) * inverse);
    sample_[4][k] = 1.0F;
  }
  return {sample_[0].data(), sample_[1].data(), sample_[2].data(),
          sample_[3].data(), sample_[4].data(), padded};
}

}  // namespace oneac::internal
