#pragma once

#include "oneac/base/image.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace cv {
class Mat;
}

namespace oneac {

/// The grey levels that a camera uses of 16 bits. A drive's images share one number, or a stretch
/// without anything bright would come out four times as bright as the image before it.
class GreyRange {
 public:
  /// The number of an image that has `levels` by itself: the drive's, which is that of the first
  /// image asked for, unless this one needs more.
  double of(double levels) {
    if (drive_ == 0.0) drive_ = levels;
    return levels > drive_ ? levels : drive_;
  }

 private:
  double drive_ = 0.0;  ///< 0: no 16-bit image yet
};

/// Reads a JPEG, PNG, BMP, PGM, PPM, TIFF (its first picture) or WebP file as 8-bit grey (colour,
/// 16-bit and alpha are converted; no rotation by EXIF). A colour JPEG gives the luminance that it
/// stores.
/// @throws InputError naming the file when it cannot be read, decoded, or ends early
[[nodiscard]] GreyImage decode_grey_file(const std::filesystem::path& file);
/// The same for an image of a drive.
[[nodiscard]] GreyImage decode_grey_file(const std::filesystem::path& file, GreyRange& drive);

/// The same for the content of such a file.
[[nodiscard]] GreyImage decode_grey_bytes(const std::vector<std::uint8_t>& bytes,
                                          const std::string& name);

/// The same for an image that is stored in a log: decoded in colour and converted by to_grey(), as
/// of an observation that MRPT has decoded.
[[nodiscard]] GreyImage decode_grey_by_colour(const std::vector<std::uint8_t>& bytes,
                                              const std::string& name);

/// Converts decoded pixels (1, 3 or 4 channels in OpenCV's order, 8 or 16 bit) to 8-bit grey.
/// @throws InputError naming the image when it is empty or of another kind
[[nodiscard]] GreyImage to_grey(const cv::Mat& pixels, const std::string& name);
/// The same for an image of a drive.
[[nodiscard]] GreyImage to_grey(const cv::Mat& pixels, const std::string& name, GreyRange& drive);

}  // namespace oneac
