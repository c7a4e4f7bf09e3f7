#include "decompressing_stream.h"

#include "oneac/base/error.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace oneac {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 18;
// No sound record reads more than this at once (a raw 8k colour image has 100 MB): a greater wish
// is a damaged length.
constexpr std::size_t kLargestRead = std::size_t{1} << 29;
constexpr const char* kCopyAgain = "copy the file again from where it came";

}  // namespace

struct DecompressingStream::File {
  std::ifstream stream;
  std::uint64_t size = 0;
  std::uint64_t read = 0;
};

DecompressingStream::DecompressingStream(const std::filesystem::path& file)
    : file_(std::make_unique<File>()), in_(kBufferBytes), out_(kBufferBytes) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) {
    throw InputError(file.string(), "no such file", "check the name of the log");
  }
  if (std::filesystem::is_directory(file, ignored)) {
    throw InputError(file.string(), "is a folder", "give the .rawlog file in it");
  }
  file_->stream.open(file, std::ios::binary);
  if (!file_->stream) throw InputError(file.string(), "cannot be opened", "check its permissions");
  const auto size = std::filesystem::file_size(file, ignored);
  file_->size = ignored ? 0 : size;
  read_input();
  if (in_end_ == 0) throw InputError(file.string(), "the file is empty", kCopyAgain);
  decompressor_ = make_decompressor(in_.data(), in_end_);
  if (decompressor_) compression_ = decompressor_->name();
}

DecompressingStream::~DecompressingStream() = default;

void DecompressingStream::read_input() {
  in_begin_ = 0;
  file_->stream.read(reinterpret_cast<char*>(in_.data()), static_cast<std::streamsize>(in_.size()));
  in_end_ = static_cast<std::size_t>(file_->stream.gcount());
  file_->read += in_end_;
  if (file_->stream.bad()) fault_ = "the file cannot be read on";
}

// Fills the output buffer with at least one byte, or sets ended_.
void DecompressingStream::refill() {
  out_begin_ = out_end_ = 0;
  while (out_end_ == 0 && !ended_) {
    bool input_ended = false;
    if (in_begin_ == in_end_) {
      read_input();
      input_ended = in_end_ == 0;
    }
    if (!decompressor_) {
      std::swap(in_, out_);
      out_end_ = in_end_;
      in_begin_ = in_end_ = 0;
      ended_ = out_end_ == 0;
      continue;
    }
    // Also called without input: a decompressor may still hold output.
    const auto piece = decompressor_->decompress(in_.data() + in_begin_, in_end_ - in_begin_,
                                                 out_.data(), out_.size());
    in_begin_ += piece.consumed;
    out_end_ = piece.produced;
    if (fault_.empty()) fault_ = piece.fault;
    const bool exhausted = input_ended && piece.produced == 0;
    if (exhausted && fault_.empty()) fault_ = decompressor_->fault_at_end();
    ended_ = exhausted || !fault_.empty();
  }
}

bool DecompressingStream::at_end() {
  if (out_begin_ == out_end_ && !ended_) refill();
  return out_begin_ == out_end_ && ended_;
}

size_t DecompressingStream::Read(void* buffer, size_t count) {
  if (count > kLargestRead) {
    if (fault_.empty()) fault_ = "a record claims an absurd size";
    return 0;
  }
  std::size_t done = 0;
  while (done < count && !at_end()) {
    const std::size_t n = std::min(count - done, out_end_ - out_begin_);
    std::memcpy(static_cast<std::uint8_t*>(buffer) + done, out_.data() + out_begin_, n);
    out_begin_ += n;
    done += n;
  }
  delivered_ += done;
  ran_out_ = ran_out_ || done < count;
  return done;
}

size_t DecompressingStream::Write(const void* /*buffer*/, size_t /*count*/) {
  throw std::logic_error("DecompressingStream is for reading only");
}

uint64_t DecompressingStream::Seek(int64_t /*offset*/, TSeekOrigin /*origin*/) {
  throw std::logic_error("DecompressingStream reads forward only");
}

uint64_t DecompressingStream::getTotalBytesCount() const {
  return file_->size;
}
uint64_t DecompressingStream::getPosition() const {
  return delivered_;
}

double DecompressingStream::progress() const {
  if (file_->size == 0) return ended_ ? 1.0 : 0.0;
  const auto used = static_cast<double>(file_->read - (in_end_ - in_begin_));
  return std::min(1.0, used / static_cast<double>(file_->size));
}

}  // namespace oneac
