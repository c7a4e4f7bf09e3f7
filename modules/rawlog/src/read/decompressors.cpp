#include "read/decompressing_stream.h"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

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

std::unique_ptr<Decompressor> one_decompressor(const std::uint8_t* head, std::size_t size) {
  if (starts_with(head, size, {0x1f, 0x8b})) return std::make_unique<GzipDecompressor>();
  if (starts_with(head, size, {0x28, 0xb5, 0x2f, 0xfd}))
    return std::make_unique<ZstdDecompressor>();
  return nullptr;
}

/// MRPT packs its logs itself; somebody who packs a file for sending packs it once more.
class TwiceDecompressor : public Decompressor {
 public:
  explicit TwiceDecompressor(std::unique_ptr<Decompressor> outer) : outer_(std::move(outer)) {}

  Piece decompress(const std::uint8_t* in, std::size_t in_size, std::uint8_t* out,
                   std::size_t out_size) override {
    Piece piece;
    const bool wants_more = begin_ == end_ || !looked_;
    if (wants_more && outer_fault_.empty()) piece.consumed = unpack_outer(in, in_size);
    if (!look() && piece.consumed > 0) return piece;
    const std::uint8_t* from = middle_.data() + begin_;
    if (inner_) {
      const Piece unpacked = inner_->decompress(from, end_ - begin_, out, out_size);
      begin_ += unpacked.consumed;
      piece.produced = unpacked.produced;
      piece.fault = unpacked.fault;
    } else {
      piece.produced = std::min(out_size, end_ - begin_);
      std::copy_n(from, piece.produced, out);
      begin_ += piece.produced;
    }
    // What came before the fault goes first.
    if (begin_ == end_ && piece.fault.empty()) piece.fault = outer_fault_;
    return piece;
  }
  [[nodiscard]] std::string fault_at_end() const override {
    const std::string fault = outer_->fault_at_end();
    return fault.empty() && inner_ ? inner_->fault_at_end() : fault;
  }
  [[nodiscard]] std::string name() const override { return outer_->name(); }

 private:
  static constexpr std::size_t kMiddle = std::size_t{1} << 18U, kMagic = 4;

  /// @return bytes of the input that were used
  std::size_t unpack_outer(const std::uint8_t* in, std::size_t in_size) {
    if (begin_ == end_) begin_ = end_ = 0;
    const Piece unpacked =
        outer_->decompress(in, in_size, middle_.data() + end_, middle_.size() - end_);
    end_ += unpacked.produced;
    outer_fault_ = unpacked.fault;
    at_rest_ = unpacked.consumed == 0 && unpacked.produced == 0;
    return unpacked.consumed;
  }
  /// @return whether it is known what the first layer holds
  bool look() {
    if (looked_) return true;
    looked_ = end_ - begin_ >= kMagic || at_rest_ || !outer_fault_.empty();
    if (looked_) inner_ = one_decompressor(middle_.data() + begin_, end_ - begin_);
    return looked_;
  }

  std::unique_ptr<Decompressor> outer_, inner_;
  std::vector<std::uint8_t> middle_ = std::vector<std::uint8_t>(kMiddle);
  std::size_t begin_ = 0, end_ = 0;  ///< of what of it waits
  bool looked_ = false, at_rest_ = false;
  std::string outer_fault_;
};

}  // namespace

std::unique_ptr<Decompressor> make_decompressor(const std::uint8_t* head, std::size_t size) {
  auto outer = one_decompressor(head, size);
  return outer ? std::make_unique<TwiceDecompressor>(std::move(outer)) : nullptr;
}

}  // namespace oneac
