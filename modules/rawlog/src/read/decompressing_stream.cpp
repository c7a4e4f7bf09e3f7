#include "read/decompressing_stream.h"

#include "oneac/base/error.h"
#include "oneac/base/input_file.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <utility>

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
  if (const std::string fault = fault_of_file(file); !fault.empty()) {
    throw InputError(
        file.string(), fault,
        fault == "is a folder" ? "give the .rawlog file in it" : "check the name of the log");
  }
  file_->stream.open(file, std::ios::binary);
  if (!file_->stream) throw InputError(file.string(), "cannot be opened", "check its permissions");
  std::error_code ignored;
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

// At least one byte of plain data, or none and ended_ is set.
std::size_t DecompressingStream::produce(std::uint8_t* to, std::size_t room) {
  if (decompressor_) return decompress(to, room);
  if (in_begin_ == in_end_) read_input();
  const std::size_t count = std::min(room, in_end_ - in_begin_);
  std::copy_n(in_.data() + in_begin_, count, to);
  in_begin_ += count;
  ended_ = count == 0;
  return count;
}

std::size_t DecompressingStream::decompress(std::uint8_t* to, std::size_t room) {
  std::size_t produced = 0;
  while (produced == 0 && !ended_) {
    bool input_ended = false;
    if (in_begin_ == in_end_) {
      read_input();
      input_ended = in_end_ == 0;
    }
    // Also called without input: a decompressor may still hold output.
    const auto piece =
        decompressor_->decompress(in_.data() + in_begin_, in_end_ - in_begin_, to, room);
    in_begin_ += piece.consumed;
    produced = piece.produced;
    if (fault_.empty()) fault_ = piece.fault;
    const bool exhausted = input_ended && produced == 0;
    if (exhausted && fault_.empty()) fault_ = decompressor_->fault_at_end();
    ended_ = exhausted || !fault_.empty();
  }
  return produced;
}

void DecompressingStream::refill() {
  if (out_.size() > kBufferBytes) {  // grown by a look ahead
    out_.resize(kBufferBytes);
    out_.shrink_to_fit();
  }
  out_begin_ = 0;
  out_end_ = produce(out_.data(), out_.size());
}

bool DecompressingStream::has_bytes(std::size_t count) {
  if (out_end_ - out_begin_ >= count) return true;
  if (count > kLargestRead) return false;
  std::copy(out_.data() + out_begin_, out_.data() + out_end_, out_.data());
  out_end_ -= std::exchange(out_begin_, 0);
  while (out_end_ < count && !ended_) {
    // As the bytes come, not as they are claimed: the claim may be any number.
    if (out_end_ == out_.size()) out_.resize(std::min(count, 2 * out_.size()));
    out_end_ += produce(out_.data() + out_end_, out_.size() - out_end_);
  }
  return out_end_ >= count;
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
