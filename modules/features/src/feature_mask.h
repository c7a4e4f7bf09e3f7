#pragma once

#include "oneac/base/image.h"
#include "oneac/features/feature_options.h"
#include "oneac/features/image_mask.h"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace oneac::internal {

/// White, and dark where a place [px] is not used.
template <class Unused>
[[nodiscard]] GreyImage dark_where(int width, int height, Unused&& unused) {
  constexpr std::uint8_t kWhite = 255;
  GreyImage picture(width, height, kWhite);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      if (unused(Eigen::Vector2d(u, v))) picture.row(v)[u] = 0;
    }
  }
  return picture;
}

/// Parts of the image that are not used: polygons and a picture.
class FeatureMask {
 public:
  /// @throws std::invalid_argument when a polygon cannot be read, InputError when the picture can
  /// not
  explicit FeatureMask(const MaskOptions& options);

  [[nodiscard]] bool usable(const Eigen::Vector2d& u) const;
  /// Dark where pixels are not used, of this size; empty where all are.
  [[nodiscard]] GreyImage picture(int width, int height) const;
  /// @throws InputError when the picture's size is not that of the camera's images
  void require_size(int width, int height) const;

 private:
  using Polygon = std::vector<Eigen::Vector2d>;

  std::vector<Polygon> polygons_;
  std::string path_;
  GreyImage picture_;
};

/// The mask of one image; all of it is used where `mask` is empty.
/// @throws std::invalid_argument for another size than the image's
[[nodiscard]] GreyImage mask_of_image(const ImageView& image, const ImageView& mask);

}  // namespace oneac::internal
