#include "import/bag/bag_images.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/error.h"
#include "oneac/base/printable.h"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <array>
#include <optional>
#include <string_view>

namespace oneac {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kSmallest_px = 32;  // of an image that shows a road
constexpr std::uint32_t kLargest_px = 1U << 15U;

/// An encoding of sensor_msgs/Image and how OpenCV's BGR or grey is made of it.
struct Encoding {
  const char* name;
  int type;
  std::optional<int> conversion;
};

/// OpenCV names a Bayer pattern by its second row and column, ROS by its first. ROS's yuv422 is
/// UYVY: its Y are the second bytes.
const Encoding* encoding_of(const std::string& name) {
  static const std::array<Encoding, 25> kEncodings{
      {{"mono8", CV_8UC1, {}},
       {"8UC1", CV_8UC1, {}},
       {"mono16", CV_16UC1, {}},
       {"bgr8", CV_8UC3, {}},
       {"8UC3", CV_8UC3, {}},
       {"bgr16", CV_16UC3, {}},
       {"rgb8", CV_8UC3, cv::COLOR_RGB2BGR},
       {"rgb16", CV_16UC3, cv::COLOR_RGB2BGR},
       {"bgra8", CV_8UC4, cv::COLOR_BGRA2BGR},
       {"8UC4", CV_8UC4, cv::COLOR_BGRA2BGR},
       {"bgra16", CV_16UC4, cv::COLOR_BGRA2BGR},
       {"rgba8", CV_8UC4, cv::COLOR_RGBA2BGR},
       {"rgba16", CV_16UC4, cv::COLOR_RGBA2BGR},
       {"bayer_rggb8", CV_8UC1, cv::COLOR_BayerBG2BGR},
       {"bayer_bggr8", CV_8UC1, cv::COLOR_BayerRG2BGR},
       {"bayer_gbrg8", CV_8UC1, cv::COLOR_BayerGR2BGR},
       {"bayer_grbg8", CV_8UC1, cv::COLOR_BayerGB2BGR},
       {"bayer_rggb16", CV_16UC1, cv::COLOR_BayerBG2BGR},
       {"bayer_bggr16", CV_16UC1, cv::COLOR_BayerRG2BGR},
       {"bayer_gbrg16", CV_16UC1, cv::COLOR_BayerGR2BGR},
       {"bayer_grbg16", CV_16UC1, cv::COLOR_BayerGB2BGR},
       {"yuv422", CV_8UC2, cv::COLOR_YUV2BGR_UYVY},
       {"uyvy", CV_8UC2, cv::COLOR_YUV2BGR_UYVY},
       {"yuv422_yuy2", CV_8UC2, cv::COLOR_YUV2BGR_YUY2},
       {"yuyv", CV_8UC2, cv::COLOR_YUV2BGR_YUY2}}};
  for (const Encoding& encoding : kEncodings) {
    if (name == encoding.name) return &encoding;
  }
  return nullptr;
}

const Encoding& known_encoding(const std::string& name) {
  if (const Encoding* encoding = encoding_of(name)) return *encoding;
  throw BadMessage{"its pixels are '" + shortened(printable(name), 40) +
                   "', not mono, bgr, rgb, bgra, rgba or bayer of 8 or 16 bits, nor yuv422"};
}

void require_consistent(const RosImage& image, std::size_t bytes_of_pixel) {
  const std::string size = std::to_string(image.width) + "x" + std::to_string(image.height);
  if (std::min(image.width, image.height) < kSmallest_px ||
      std::max(image.width, image.height) > kLargest_px) {
    throw BadMessage{"it says that it has " + size + " pixels: no image of a drive"};
  }
  if (image.step < image.width * bytes_of_pixel) {
    throw BadMessage{"its " + std::to_string(image.width) + " pixels of " + image.encoding +
                     " do not fit into rows of " + std::to_string(image.step) + " bytes"};
  }
  const std::size_t bytes = std::size_t{image.step} * image.height;
  if (bytes == image.pixels.size) return;
  throw BadMessage{"its " + size + " pixels of " + image.encoding + " are " +
                   std::to_string(bytes) + " bytes, it holds " + std::to_string(image.pixels.size)};
}

cv::Mat with_swapped_bytes(const cv::Mat& pixels) {
  cv::Mat swapped = pixels.clone();
  swapped.reshape(1).forEach<std::uint16_t>([](std::uint16_t& value, const int*) {
    value = static_cast<std::uint16_t>(value << 8U | value >> 8U);
  });
  return swapped;
}

/// Two pixels of YUV 4:2:2 share their colour.
void require_pairs(const RosImage& image, int type) {
  if (type != CV_8UC2 || image.width % 2 == 0) return;
  throw BadMessage{"its rows of " + image.encoding + " have " + std::to_string(image.width) +
                   " pixels, an odd number"};
}

/// The message's own pixels, in the machine's order of bytes, as OpenCV writes them.
cv::Mat pixels_of(const RosImage& image) {
  const Encoding& encoding = known_encoding(image.encoding);
  require_consistent(image, CV_ELEM_SIZE(encoding.type));
  require_pairs(image, encoding.type);
  cv::Mat pixels(static_cast<int>(image.height), static_cast<int>(image.width), encoding.type,
                 const_cast<std::uint8_t*>(image.pixels.data), image.step);
  const bool is_swapped = CV_MAT_DEPTH(encoding.type) == CV_16U && image.is_bigendian;
  if (is_swapped) pixels = with_swapped_bytes(pixels);
  if (!encoding.conversion) return pixels;
  cv::Mat converted;
  cv::cvtColor(pixels, converted, *encoding.conversion);
  return converted;
}

const char* ending_of(const RosCompressedImage& image) {
  const std::string_view begin(reinterpret_cast<const char*>(image.file.data),
                               std::min<std::size_t>(image.file.size, 8));
  if (begin.substr(0, 3) == "\xFF\xD8\xFF") return ".jpg";
  if (begin == "\x89PNG\r\n\x1A\n") return ".png";
  throw BadMessage{"it ('" + shortened(printable(image.format), 40) + "') holds no JPEG or PNG"};
}

}  // namespace

fs::path BagImages::write(const RosImage& image, const std::string& name) {
  const cv::Mat pixels = pixels_of(image);
  fs::path png = folder_ / (name + ".png");
  bool written = false;
  try {
    written = cv::imwrite(png.string(), pixels);
  } catch (const cv::Exception&) {
  }
  if (!written) throw OutputError(png.string(), "cannot be written", "free some space");
  return png;
}

fs::path BagImages::write(const RosCompressedImage& image, const std::string& name) {
  fs::path path = folder_ / (name + ending_of(image));
  write_file_atomically(
      path, std::string_view(reinterpret_cast<const char*>(image.file.data), image.file.size));
  return path;
}

}  // namespace oneac
