#include "normalised_pair.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace oneac {
namespace {

std::uint8_t grey_at(const ImageView& image, const Eigen::Vector2d& u) {
  const int column = std::clamp(static_cast<int>(std::lround(u.x())), 0, image.width - 1);
  const int row = std::clamp(static_cast<int>(std::lround(u.y())), 0, image.height - 1);
  return image.data[static_cast<std::ptrdiff_t>(row) * image.stride + column];
}

Correspondence normalised(const Correspondence& px, const PinholeCamera& first,
                          const PinholeCamera& second) {
  Correspondence ac = px;
  static_cast<AffineCorrespondence&>(ac) = normalise(px, first, second);
  ac.point_sigma = px.point_sigma / second.focal_px();
  // The rows of K are pixels of the first image, as δ and 1/η are.
  const Eigen::Vector2d per_px(1.0 / first.fx, 1.0 / first.fy);
  ac.perspective = per_px.asDiagonal() * px.perspective * per_px.asDiagonal();
  return ac;
}

}  // namespace

TrackedPair normalised(const TrackedPair& pair, const PinholeCamera& first,
                       const CameraFrame& second) {
  TrackedPair result;
  result.standing = pair.standing;
  result.correspondences.reserve(pair.size());
  const ImageView image = second.image.view();
  for (const Correspondence& px : pair.correspondences) {
    result.correspondences.push_back(normalised(px, first, second.camera));
    if (!image.empty()) result.correspondences.back().grey = grey_at(image, px.x2);
  }
  return result;
}

}  // namespace oneac
