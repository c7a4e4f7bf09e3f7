#include "oneac/base/mask.h"

#include <algorithm>
#include <cstddef>

namespace oneac {

std::string fault_of_mask(const ImageView& mask) {
  std::uint8_t brightest = 0;
  for (int v = 0; v < mask.height; ++v) {
    const std::uint8_t* row = mask.data + static_cast<std::ptrdiff_t>(v) * mask.stride;
    if (mask.width > 0) brightest = std::max(brightest, *std::max_element(row, row + mask.width));
  }
  if (brightest == 0 || brightest >= kMaskUses) return "";
  return "the mask's brightest value is " + std::to_string(brightest) +
         ", and what is below 128 is not used";
}

double share_left_out(const ImageView& mask) {
  if (mask.width <= 0 || mask.height <= 0) return 0.0;
  std::ptrdiff_t out = 0;
  for (int v = 0; v < mask.height; ++v) {
    const std::uint8_t* row = mask.data + static_cast<std::ptrdiff_t>(v) * mask.stride;
    out += std::count_if(row, row + mask.width, [](std::uint8_t p) { return p < kMaskUses; });
  }
  return static_cast<double>(out) / mask.width / mask.height;
}

GreyImage darker(GreyImage a, const GreyImage& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  for (int v = 0; v < a.height(); ++v) {
    std::transform(a.row(v), a.row(v) + a.width(), b.row(v), a.row(v),
                   [](std::uint8_t x, std::uint8_t y) { return std::min(x, y); });
  }
  return a;
}

}  // namespace oneac
