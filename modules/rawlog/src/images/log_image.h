#pragma once

#include "read/decompressing_stream.h"

#include "oneac/base/image.h"
#include "oneac/observations/image_decoding.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace oneac {

/// An image as a rawlog holds it, not decoded yet.
struct LogImage {
  enum class Kind { none, external, jpeg, grey_8, grey_16, bgr_8 };

  Kind kind = Kind::none;
  std::string file;                 ///< of an external image, as stored
  int width = 0;                    ///< [px] of raw pixels
  int height = 0;                   ///< [px]
  std::vector<std::uint8_t> bytes;  ///< JPEG, or rows of raw pixels
};

/// The images of one record, in the order in which they are stored.
using LogImages = std::vector<std::shared_ptr<const LogImage>>;

/// Reads what follows the version of a serialised mrpt::img::CImage. MRPT itself would let libjpeg
/// end the program at a damaged JPEG, and in version 0 write past its buffer.
/// @throws std::runtime_error when it is damaged, cut, or of a version that MRPT 2 does not read
[[nodiscard]] LogImage read_log_image(DecompressingStream& stream, int version);

/// 8-bit grey. Not for external images.
/// @param drive  what its images share, of 16 bits
/// @throws InputError naming the image when it cannot be decoded
[[nodiscard]] GreyImage decode_grey(const LogImage& image, const std::string& name,
                                    GreyRange& drive);

}  // namespace oneac
