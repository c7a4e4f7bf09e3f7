#include "oneac/observations/image_decoding.h"

#include "oneac/base/error.h"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

namespace oneac {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr const char* kCopyImage =
    "copy the image again, or remove it to have it counted as missing";
constexpr std::uint8_t kMarker = 0xff;                            // of a JPEG segment
constexpr std::size_t kLargestPixels = std::size_t{1} << 27;      // 134 Mpx: more is damage
constexpr std::streamoff kLargestFile = std::streamoff{1} << 29;  // [byte] raw, of that size

Bytes read_bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  if (!stream)
    throw InputError(file.string(), "the image cannot be opened", "check its permissions");
  const std::streamoff size = std::max<std::streamoff>(0, stream.tellg());
  if (size > kLargestFile) throw InputError(file.string(), "the file is no image", kCopyImage);
  Bytes bytes(static_cast<std::size_t>(size));
  stream.seekg(0);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!stream && !bytes.empty()) {
    throw InputError(file.string(), "the image cannot be read", kCopyImage);
  }
  return bytes;
}

std::size_t big_endian(const Bytes& bytes, std::size_t at, std::size_t count) {
  std::size_t value = 0;
  for (std::size_t i = at; i < at + count && i < bytes.size(); ++i) value = value * 256U + bytes[i];
  return value;
}

bool is_jpeg(const Bytes& bytes) {
  constexpr std::uint8_t kStartOfImage = 0xd8;
  return bytes.size() >= 4 && bytes[0] == kMarker && bytes[1] == kStartOfImage;
}

// Where the pixels of a JPEG begin, and the size that a segment before them states (0 without).
struct JpegHeader {
  std::size_t scan = 2;
  std::size_t pixels = 0;
};

JpegHeader jpeg_header(const Bytes& bytes) {
  constexpr std::uint8_t kStartOfScan = 0xda;
  constexpr std::uint8_t kFirstFrame = 0xc0;
  constexpr std::uint8_t kLastFrame = 0xcf;
  constexpr std::uint8_t kHuffmanTable = 0xc4;  // between the frames' codes, but no frame
  JpegHeader header;
  std::size_t& at = header.scan;
  while (at + 4 <= bytes.size() && bytes[at] == kMarker && bytes[at + 1] != kStartOfScan) {
    const std::uint8_t code = bytes[at + 1];
    if (code >= kFirstFrame && code <= kLastFrame && code != kHuffmanTable) {
      header.pixels =
          std::max(header.pixels, big_endian(bytes, at + 5, 2) * big_endian(bytes, at + 7, 2));
    }
    at += 2U + big_endian(bytes, at + 2, 2);
  }
  return header;
}

// libjpeg fills what is missing of a cut file with grey and calls it a success: look for the end
// marker behind the header segments (a thumbnail in the header has one of its own).
bool is_cut_jpeg(const Bytes& bytes) {
  if (!is_jpeg(bytes)) return false;
  const std::size_t begin = jpeg_header(bytes).scan;
  if (begin >= bytes.size()) return true;
  constexpr std::uint8_t kEndOfImage = 0xd9;
  const std::uint8_t end[] = {kMarker, kEndOfImage};
  const auto scan = bytes.begin() + static_cast<std::ptrdiff_t>(begin);
  return std::search(scan, bytes.end(), std::begin(end), std::end(end)) == bytes.end();
}

bool begins_with(const Bytes& bytes, std::string_view magic) {
  return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
}

std::size_t little_endian(const Bytes& bytes, std::size_t at) {
  std::size_t value = 0;
  for (std::size_t i = at + 4; i-- > at;) value = value * 256U + (i < bytes.size() ? bytes[i] : 0U);
  return value;
}

// "P5 640 480 255": the size of a portable map; 0 when it is another.
std::size_t portable_map_pixels(const Bytes& bytes) {
  constexpr std::size_t kLongestHeader = 1024;  // [byte] comments included
  const auto end =
      bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), kLongestHeader));
  std::istringstream header(std::string(bytes.begin() + 2, end));
  std::size_t sides[2] = {0, 0};
  for (std::size_t& side : sides) {
    while ((header >> std::ws).peek() == '#') {
      header.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    }
    if (!(header >> side) || side > kLargestPixels) return kLargestPixels + 1;
  }
  return sides[0] * sides[1];
}

// Of a TIFF, in either order of bytes: what its first directory says. Nothing without a directory.
std::optional<std::size_t> tiff_pixels(const Bytes& bytes) {
  constexpr std::size_t kEntry = 12, kWidth = 256, kHeight = 257, kShort = 3;
  const bool big = begins_with(bytes, std::string_view("MM\0*", 4));
  if (!big && !begins_with(bytes, std::string_view("II*\0", 4))) return std::nullopt;
  const auto number = [&](std::size_t at, std::size_t count) {
    if (big) return big_endian(bytes, at, count);
    std::size_t value = 0;
    for (std::size_t i = count; i-- > 0;) {
      value = value * 256U + (at + i < bytes.size() ? bytes[at + i] : 0U);
    }
    return value;
  };
  const std::size_t directory = number(4, 4);
  if (directory + 2 > bytes.size()) return kLargestPixels + 1;
  std::size_t width = 0, height = 0;
  for (std::size_t i = 0; i < number(directory, 2); ++i) {
    const std::size_t at = directory + 2 + kEntry * i;
    if (at + kEntry > bytes.size()) break;
    const std::size_t value = number(at + 8, number(at + 2, 2) == kShort ? 2 : 4);
    if (number(at, 2) == kWidth) width = value;
    if (number(at, 2) == kHeight) height = value;
  }
  return width * height;
}

// Of a WebP of one of its three kinds; nothing for another.
std::optional<std::size_t> webp_pixels(const Bytes& bytes) {
  constexpr std::size_t kKind = 12, kSide = 0x3fff;  // 14 bits
  if (!begins_with(bytes, "RIFF") || bytes.size() < 30) return std::nullopt;
  if (std::memcmp(bytes.data() + 8, "WEBP", 4) != 0) return std::nullopt;
  const std::string_view kind(reinterpret_cast<const char*>(bytes.data() + kKind), 4);
  if (kind == "VP8 ") {
    const std::size_t sides = little_endian(bytes, 26);
    return (sides & kSide) * (sides >> 16U & kSide);
  }
  if (kind == "VP8L") {
    const std::size_t sides = little_endian(bytes, 21);
    return ((sides & kSide) + 1) * ((sides >> 14U & kSide) + 1);
  }
  if (kind != "VP8X") return std::nullopt;
  const auto side = [&](std::size_t at) { return (little_endian(bytes, at) & 0xffffffU) + 1; };
  return side(24) * side(27);
}

// What an image says of its size: a few damaged bytes ask for gigabytes. Nothing for a format that
// is not read: OpenCV has decoders for many, each with faults of its own.
std::optional<std::size_t> claimed_pixels(const Bytes& bytes) {
  if (is_jpeg(bytes)) return jpeg_header(bytes).pixels;
  if (begins_with(bytes, "\x89PNG")) return big_endian(bytes, 16, 4) * big_endian(bytes, 20, 4);
  if (begins_with(bytes, "BM")) {
    const auto side = [&](std::size_t at) {  // a negative height stands for rows from the top
      const auto value = static_cast<std::int32_t>(little_endian(bytes, at));
      return static_cast<std::size_t>(std::abs(std::int64_t{value}));
    };
    return side(18) * side(22);
  }
  const bool portable_map = bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '2' &&
                            bytes[1] <= '6' && std::isspace(bytes[2]) != 0;
  if (portable_map) return portable_map_pixels(bytes);
  if (const auto tiff = tiff_pixels(bytes)) return tiff;
  return webp_pixels(bytes);
}

GreyImage decoded(const Bytes& bytes, const std::string& name, int flags, GreyRange& drive) {
  if (bytes.empty()) throw InputError(name, "the image file is empty", kCopyImage);
  if (is_cut_jpeg(bytes)) throw InputError(name, "the image ends early", kCopyImage);
  const auto pixel_count = claimed_pixels(bytes);
  if (!pixel_count) {
    throw InputError(name, "the image cannot be decoded: no JPEG, PNG, BMP, PGM, PPM, TIFF or WebP",
                     kCopyImage);
  }
  if (*pixel_count > kLargestPixels) {
    throw InputError(name, "the image claims an absurd size", kCopyImage);
  }
  cv::Mat pixels;
  try {
    pixels = cv::imdecode(bytes, flags | cv::IMREAD_ANYDEPTH | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    pixels.release();
  }
  if (pixels.empty()) throw InputError(name, "the image cannot be decoded", kCopyImage);
  return to_grey(pixels, name, drive);
}

}  // namespace

GreyImage decode_grey_file(const std::filesystem::path& file) {
  GreyRange alone;
  return decode_grey_file(file, alone);
}

GreyImage decode_grey_file(const std::filesystem::path& file, GreyRange& drive) {
  return decoded(read_bytes(file), file.string(), cv::IMREAD_GRAYSCALE, drive);
}

GreyImage decode_grey_bytes(const Bytes& bytes, const std::string& name) {
  GreyRange alone;
  return decoded(bytes, name, cv::IMREAD_GRAYSCALE, alone);
}

GreyImage decode_grey_by_colour(const Bytes& bytes, const std::string& name) {
  GreyRange none;  // a JPEG has 8 bits
  return decoded(bytes, name, cv::IMREAD_ANYCOLOR, none);
}

namespace {

/// The grey levels that the sensor had: cameras of 10, 12 or 14 bits leave the upper bits of a
/// 16-bit image empty. A daylight image comes within half of its brightest level, so the least
/// number of bits that holds its brightest pixel tells; with even numbers of them only, a dark one
/// is rarely mistaken.
double range_of(const cv::Mat& grey16) {
  double brightest = 0.0;
  cv::minMaxLoc(grey16, nullptr, &brightest);
  for (const double range : {256.0, 1024.0, 4096.0, 16384.0}) {
    if (brightest < range) return range;
  }
  return 65536.0;
}

}  // namespace

GreyImage to_grey(const cv::Mat& pixels, const std::string& name) {
  GreyRange alone;
  return to_grey(pixels, name, alone);
}

GreyImage to_grey(const cv::Mat& pixels, const std::string& name, GreyRange& drive) {
  const bool known_depth = pixels.depth() == CV_8U || pixels.depth() == CV_16U;
  const int channels = pixels.channels();
  if (pixels.empty() || !known_depth || (channels != 1 && channels != 3 && channels != 4)) {
    throw InputError(name, "the image is empty or neither 8 nor 16 bit with 1, 3 or 4 channels",
                     "convert the images to 8-bit grey");
  }
  cv::Mat grey = pixels;
  if (channels == 3) cv::cvtColor(pixels, grey, cv::COLOR_BGR2GRAY);
  if (channels == 4) cv::cvtColor(pixels, grey, cv::COLOR_BGRA2GRAY);
  if (grey.depth() == CV_16U) {
    cv::Mat narrow;
    grey.convertTo(narrow, CV_8U, 256.0 / drive.of(range_of(grey)));
    grey = narrow;
  }
  return GreyImage(ImageView{grey.data, grey.cols, grey.rows, static_cast<int>(grey.step)});
}

}  // namespace oneac
