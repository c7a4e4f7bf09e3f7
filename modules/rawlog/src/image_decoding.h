#pragma once

#include <opencv2/core.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace oneac {

/// Reads a JPEG, PNG, BMP, PGM or PPM file as 8-bit grey (colour, 16-bit and alpha are converted;
/// no rotation by EXIF).
/// @throws InputError naming the file when it cannot be read, decoded, or ends early
[[nodiscard]] cv::Mat decode_grey_file(const std::filesystem::path& file);

/// The same for the content of such a file.
[[nodiscard]] cv::Mat decode_grey_bytes(const std::vector<std::uint8_t>& bytes,
                                        const std::string& name);

/// Converts decoded pixels (1, 3 or 4 channels in OpenCV's order, 8 or 16 bit) to 8-bit grey.
/// @throws InputError naming the image when it is empty or of another kind
[[nodiscard]] cv::Mat to_grey(const cv::Mat& pixels, const std::string& name);

}  // namespace oneac
