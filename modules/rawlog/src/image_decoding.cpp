#include "image_decoding.h"

#include "oneac/base/error.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <vector>

namespace oneac {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr const char* kCopyImage =
    "copy the image again, or remove it to have it counted as missing";
constexpr double k16To8Bit = 1.0 / 256.0;  // keeps the upper byte

Bytes read_bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  if (!stream)
    throw InputError(file.string(), "the image cannot be opened", "check its permissions");
  Bytes bytes(static_cast<std::size_t>(std::max<std::streamoff>(0, stream.tellg())));
  stream.seekg(0);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!stream && !bytes.empty()) {
    throw InputError(file.string(), "the image cannot be read", kCopyImage);
  }
  return bytes;
}

// libjpeg fills what is missing of a cut file with grey and calls it a success: look for the end
// marker behind the header segments (a thumbnail in the header has one of its own).
bool is_cut_jpeg(const Bytes& bytes) {
  constexpr std::uint8_t kMarker = 0xff;
  constexpr std::uint8_t kStartOfImage = 0xd8;
  constexpr std::uint8_t kStartOfScan = 0xda;
  constexpr std::uint8_t kEndOfImage = 0xd9;
  if (bytes.size() < 4 || bytes[0] != kMarker || bytes[1] != kStartOfImage) return false;
  std::size_t at = 2;
  while (at + 4 <= bytes.size() && bytes[at] == kMarker && bytes[at + 1] != kStartOfScan) {
    at += 2U + static_cast<std::size_t>(bytes[at + 2]) * 256U + bytes[at + 3];
  }
  if (at >= bytes.size()) return true;
  const std::uint8_t end[] = {kMarker, kEndOfImage};
  const auto scan = bytes.begin() + static_cast<std::ptrdiff_t>(at);
  return std::search(scan, bytes.end(), std::begin(end), std::end(end)) == bytes.end();
}

}  // namespace

cv::Mat decode_grey_file(const std::filesystem::path& file) {
  const Bytes bytes = read_bytes(file);
  if (bytes.empty()) throw InputError(file.string(), "the image file is empty", kCopyImage);
  if (is_cut_jpeg(bytes)) throw InputError(file.string(), "the image ends early", kCopyImage);
  cv::Mat pixels;
  try {
    constexpr int kAsStored = cv::IMREAD_ANYDEPTH | cv::IMREAD_IGNORE_ORIENTATION;
    pixels = cv::imdecode(bytes, cv::IMREAD_GRAYSCALE | kAsStored);
  } catch (const cv::Exception&) {
    pixels.release();
  }
  if (pixels.empty()) throw InputError(file.string(), "the image cannot be decoded", kCopyImage);
  return to_grey(pixels, file.string());
}

cv::Mat to_grey(const cv::Mat& pixels, const std::string& name) {
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
    grey.convertTo(narrow, CV_8U, k16To8Bit);
    grey = narrow;
  }
  return grey;
}

}  // namespace oneac
