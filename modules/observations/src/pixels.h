#pragma once

#include "oneac/base/image.h"
#include "oneac/observations/image_decoding.h"

#include <mrpt/img/CImage.h>

#include <optional>
#include <string>

namespace oneac {

/// Whether an image has pixels: in memory, or in a file that is there.
[[nodiscard]] bool is_there(const mrpt::img::CImage& image);

/// The path of an external image, else `where`.
[[nodiscard]] std::string name_of(const mrpt::img::CImage& image, const std::string& where);

/// 8-bit grey. An external image is read from its file, in memory or not: MRPT's own loading turns
/// colour into other grey, and keeps it.
/// @param where  for messages about an image in memory
/// @param drive  what its images share, of 16 bits
/// @throws InputError when it cannot be read or decoded
[[nodiscard]] GreyImage grey_of(const mrpt::img::CImage& image, const std::string& where,
                                GreyRange& drive);

}  // namespace oneac
