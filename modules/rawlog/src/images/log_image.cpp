#include "images/log_image.h"

#include <opencv2/core.hpp>

#include <stdexcept>
#include <utility>

namespace oneac {
namespace {

using Kind = LogImage::Kind;

constexpr int kExternalSince = 6;          // version from which an image may be a file of its own
constexpr int kSizeSince = 7;              // version from which a colour image begins with its size
constexpr int kZipSince = 3;               // version from which grey pixels may be zipped
constexpr int kZipFlagSince = 5;           // version from which a flag says so
constexpr int kUnzippedBytes = 16 * 1024;  // version 4: more were zipped
constexpr int kDepthSince = 9;             // version from which grey pixels have a depth
constexpr int kLatest = 9;                 // the last version of MRPT 2
constexpr int kWithoutOpenCv = 100;
constexpr std::int32_t kDepth16 = 2;  // mrpt::img::PixelDepth::D16U
constexpr std::int32_t kLargestSide = 1 << 16;
constexpr std::int64_t kLargestPixels = std::int64_t{1} << 28;

/// The fields of an image, little-endian.
class Fields {
 public:
  explicit Fields(DecompressingStream& stream) : stream_(stream) {}

  std::uint8_t byte() { return bytes(1).front(); }
  std::int32_t int32() {
    const auto b = bytes(4);
    const auto at = [&](std::size_t i) { return static_cast<std::uint32_t>(b[i]) << (8 * i); };
    return static_cast<std::int32_t>(at(0) | at(1) | at(2) | at(3));
  }
  std::vector<std::uint8_t> bytes(std::size_t count) {
    if (!stream_.has_bytes(count)) {
      throw std::runtime_error("an image claims more bytes than the file has");
    }
    std::vector<std::uint8_t> content(count);
    stream_.Read(content.data(), count);
    return content;
  }
  std::vector<std::uint8_t> block() { return bytes(static_cast<std::uint32_t>(int32())); }

 private:
  DecompressingStream& stream_;
};

void set_size(LogImage& image, std::int64_t width, std::int64_t height) {
  const bool sane = width >= 0 && height >= 0 && width < kLargestSide && height < kLargestSide &&
                    width * height <= kLargestPixels;
  if (!sane) throw std::runtime_error("an image claims an absurd size");
  image.width = static_cast<int>(width);
  image.height = static_cast<int>(height);
}

bool is_zipped(Fields& fields, int version, std::int32_t size) {
  if (version >= kZipFlagSince) return fields.byte() != 0;
  return version == kZipSince || (version == kZipSince + 1 && size > kUnzippedBytes);
}

void read_grey(Fields& fields, int version, LogImage& image) {
  const std::int32_t width = fields.int32();
  set_size(image, width, fields.int32());
  static_cast<void>(fields.int32());  // the origin; MRPT 2 ignores it too
  const std::int32_t size = fields.int32();
  const bool wide = version >= kDepthSince && fields.int32() == kDepth16;
  const std::int64_t expected = std::int64_t{image.width} * image.height * (wide ? 2 : 1);
  if (size != expected) throw std::runtime_error("an image has other bytes than its size tells");
  if (is_zipped(fields, version, size)) {
    throw std::runtime_error("an image is zipped, which MRPT 2 does not read");
  }
  image.bytes = fields.bytes(static_cast<std::size_t>(size));
  if (size > 0) image.kind = wide ? Kind::grey_16 : Kind::grey_8;
}

void read_jpeg(Fields& fields, LogImage& image) {
  image.bytes = fields.block();
  image.kind = Kind::jpeg;
}

void read_colour(Fields& fields, int version, LogImage& image) {
  if (version < kSizeSince) return read_jpeg(fields, image);
  const std::int64_t width = fields.int32();
  const std::int64_t height = fields.int32();
  if (width > 0 && height > 0) return read_jpeg(fields, image);
  if (width >= 0 || height >= 0) return;  // no pixels
  set_size(image, -width, -height);       // negative sizes mark raw pixels
  image.bytes = fields.bytes(3U * static_cast<std::size_t>(image.width) *
                             static_cast<std::size_t>(image.height));
  image.kind = Kind::bgr_8;
}

void read_external(Fields& fields, LogImage& image) {
  const auto name = fields.block();
  image.file.assign(name.begin(), name.end());
  image.kind = Kind::external;
}

}  // namespace

LogImage read_log_image(DecompressingStream& stream, int version) {
  const bool known = (version >= 1 && version <= kLatest) || version == kWithoutOpenCv;
  if (!known) {
    throw std::runtime_error("an image has version " + std::to_string(version) +
                             ", which is not read");
  }
  Fields fields(stream);
  LogImage image;
  if (version >= kExternalSince && fields.byte() != 0) {
    read_external(fields, image);
  } else if (version == kWithoutOpenCv) {
    return image;
  } else if (version == 1) {
    read_jpeg(fields, image);
  } else if (fields.byte() == 0) {
    read_grey(fields, version, image);
  } else {
    read_colour(fields, version, image);
  }
  return image;
}

GreyImage decode_grey(const LogImage& image, const std::string& name, GreyRange& drive) {
  if (image.kind == Kind::jpeg) return decode_grey_by_colour(image.bytes, name);
  const int type = image.kind == Kind::grey_16 ? CV_16U : CV_8U;
  const int channels = image.kind == Kind::bgr_8 ? 3 : 1;
  auto* data = const_cast<std::uint8_t*>(image.bytes.data());
  const cv::Mat pixels(image.height, image.width, CV_MAKETYPE(type, channels), data);
  return to_grey(pixels, name, drive);
}

}  // namespace oneac
