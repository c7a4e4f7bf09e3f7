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

}  // namespace oneac
