#pragma once

#include "oneac/base/image.h"

#include <cstdint>
#include <string>

namespace oneac {

/// A mask leaves pixels in use where it is not dark: from half of white on.
inline constexpr std::uint8_t kMaskUses = 128;

/// What is wrong with a mask: one of zeros and ones, or of labels, is dark all over though it tells
/// pixels apart. "" for a sound one, also for one that is black.
[[nodiscard]] std::string fault_of_mask(const ImageView& mask);

/// The share of its pixels that a mask leaves out. [-]; 0 without a mask
[[nodiscard]] double share_left_out(const ImageView& mask);

/// Dark where either is; an empty picture is dark nowhere. @pre the same size
[[nodiscard]] GreyImage darker(GreyImage a, const GreyImage& b);

/// For messages about such a mask.
inline constexpr const char* kMaskCure = "write 255 where pixels are used and 0 where not";

}  // namespace oneac
