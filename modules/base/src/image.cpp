#include "oneac/base/image.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace oneac {

GreyImage::GreyImage(int width, int height, std::uint8_t fill) : width_(width), height_(height) {
  if (width < 0 || height < 0) {
    throw std::invalid_argument("GreyImage: size " + std::to_string(width) + " x " +
                                std::to_string(height) + " must not be negative");
  }
  pixels_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill);
}

GreyImage::GreyImage(const ImageView& view) : GreyImage(view.width, view.height) {
  for (int v = 0; v < height_; ++v) {
    const std::uint8_t* from = view.data + static_cast<std::ptrdiff_t>(v) * view.stride;
    std::copy(from, from + width_, row(v));
  }
}

}  // namespace oneac
