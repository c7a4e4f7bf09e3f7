#include "read/decompressing_stream.h"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace oneac {
namespace {

constexpr int kGzipWindow = 15 + 16;  // zlib: the largest window, gzip header expected

class GzipDecompressor : public Decompressor {
 public:
  GzipDecompressor() {
    if (inflateInit2(&z_, kGzipWindow) != Z_OK) throw std::runtime_error("zlib does not start");
  }
  ~GzipDecompressor() override { inflateEnd(&z_); }
  GzipDecompressor(const GzipDecompressor&) = delete;
  GzipDecompressor& operator=(const GzipDecompressor&) = delete;

  Piece decompress(const std::uint8_t* in, std::size_t in_size, std::uint8_t* out,
                   std::size_t out_size) override {
    if (between_members_) return next_member(in, in_size);
    z_.next_in = const_cast<Bytef*>(in);
    z_.avail_in = static_cast<uInt>(in_size);
    z_.next_out = out;
    z_.avail_out = static_cast<uInt>(out_size);
    const int code = inflate(&z_, Z_NO_FLUSH);
    between_members_ = code == Z_STREAM_END;
    Piece piece{in_size - z_.avail_in, out_size - z_.avail_out, ""};
    const bool sound = code == Z_OK || code == Z_STREAM_END || code == Z_BUF_ERROR;
    if (!sound) piece.fault = std::string("the gzip data is damaged (") + reason() + ")";
    return piece;
  }
  [[nodiscard]] std::string fault_at_end() const override {
    return between_members_ ? "" : "the gzip data ends early";
  }
  [[nodiscard]] std::string name() const override { return "gzip"; }

 private:
  [[nodiscard]] const char* reason() const { return z_.msg != nullptr ? z_.msg : "unknown code"; }

  // gzip files may be concatenated; some writers pad the end with zeros.
  Piece next_member(const std::uint8_t* in, std::size_t in_size) {
    const std::uint8_t* end = in + in_size;
    const std::uint8_t* start = std::find_if(in, end, [](std::uint8_t b) { return b != 0; });
    Piece piece{static_cast<std::size_t>(start - in), 0, ""};
    if (start == end) return piece;
    constexpr std::uint8_t kFirstMagicByte = 0x1f;
    if (*start != kFirstMagicByte) {
      piece.fault = "there is something else behind the gzip data";
      return piece;
    }
    inflateReset(&z_);
    between_members_ = false;
    return piece;
  }

  z_stream z_{};
  bool between_members_ = false;
};

class ZstdDecompressor : public Decompressor {
 public:
  ZstdDecompressor() : z_(ZSTD_createDStream()) {
    if (z_ == nullptr) throw std::runtime_error("zstd does not start");
  }
  ~ZstdDecompressor() override { ZSTD_freeDStream(z_); }
  ZstdDecompressor(const ZstdDecompressor&) = delete;
  ZstdDecompressor& operator=(const ZstdDecompressor&) = delete;

  Piece decompress(const std::uint8_t* in, std::size_t in_size, std::uint8_t* out,
                   std::size_t out_size) override {
    if (between_frames_ && in_size == 0) return {};  // a call would announce another frame
    ZSTD_inBuffer input{in, in_size, 0};
    ZSTD_outBuffer output{out, out_size, 0};
    const std::size_t code = ZSTD_decompressStream(z_, &output, &input);
    Piece piece{input.pos, output.pos, ""};
    if (ZSTD_isError(code) != 0U) {
      piece.fault = std::string("the zstd data is damaged (") + ZSTD_getErrorName(code) + ")";
    } else {
      between_frames_ = code == 0;
    }
    return piece;
  }
  [[nodiscard]] std::string fault_at_end() const override {
    return between_frames_ ? "" : "the zstd data ends early";
  }
  [[nodiscard]] std::string name() const override { return "zstd"; }

 private:
  ZSTD_DStream* z_;
  bool between_frames_ = false;
};

bool starts_with(const std::uint8_t* head, std::size_t size,
                 const std::vector<std::uint8_t>& magic) {
  return size >= magic.size() && std::equal(magic.begin(), magic.end(), head);
}

}  // namespace

std::unique_ptr<Decompressor> make_decompressor(const std::uint8_t* head, std::size_t size) {
  if (starts_with(head, size, {0x1f, 0x8b})) return std::make_unique<GzipDecompressor>();
  if (starts_with(head, size, {0x28, 0xb5, 0x2f, 0xfd}))
    return std::make_unique<ZstdDecompressor>();
  return nullptr;
}

}  // namespace oneac
