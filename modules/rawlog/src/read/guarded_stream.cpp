#include "read/guarded_stream.h"

#include <mrpt/rtti/CObject.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace oneac {
namespace {

constexpr std::uint8_t kNewFormat = 0x80;       // set in the first byte of an object since 2007
constexpr std::uint8_t kSubstituteVersion = 8;  // of CImage
constexpr std::size_t kWord = sizeof(std::uint32_t);

std::uintptr_t stack_address() {
  return reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
}

std::string little_endian(std::uint32_t value) {
  std::string text;
  for (std::size_t i = 0; i < kWord; ++i) text += static_cast<char>(value >> (8 * i) & 0xffU);
  return text;
}

std::uint32_t word_of(const std::uint8_t* bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < kWord; ++i) value |= static_cast<std::uint32_t>(bytes[i]) << (8 * i);
  return value;
}

// Four letters, as a string of that length has them. UTF-8 has no byte from 0xf8 on.
bool is_text(const std::uint8_t* bytes) {
  return std::all_of(bytes, bytes + kWord, [](std::uint8_t b) { return b >= ' ' && b < 0xf8; });
}

// MRPT knows the class, but no object of it can be made.
bool is_abstract(const std::string& class_name) {
  const mrpt::rtti::TRuntimeClassId* known = mrpt::rtti::findRegisteredClass(class_name);
  return known != nullptr && !known->ptrCreateObject;
}

}  // namespace

void GuardedStream::begin_record() {
  images_.clear();
  substitute_.clear();
  expected_ = Expected::anything;
  last_count_ = 0;
  largest_ = kLargestCount;
  stack_ = stack_address();
}

LogImages GuardedStream::take_images() {
  return std::exchange(images_, {});
}

void GuardedStream::check_depth() const {
  const std::uintptr_t here = stack_address();
  if (std::max(here, stack_) - std::min(here, stack_) < kDeepestStack) return;
  throw std::runtime_error("its objects are nested too deep");
}

size_t GuardedStream::Read(void* buffer, size_t count) {
  check_depth();
  auto* bytes = static_cast<std::uint8_t*>(buffer);
  if (!substitute_.empty()) return read_substitute(bytes, count);
  // MRPT takes three bytes of a number at the end of a file for the number: it gets none.
  if (stream_.Read(buffer, count) < count) return 0;
  follow(bytes, count);
  return count;
}

size_t GuardedStream::read_substitute(std::uint8_t* buffer, size_t count) {
  const std::size_t done = std::min(count, substitute_.size());
  std::memcpy(buffer, substitute_.data(), done);
  substitute_.erase(0, done);
  return done;
}

// An object begins with the length of its class's name (one byte; three zeros more before 2007),
// the name and a version (one byte; four before 2007).
void GuardedStream::follow(std::uint8_t* buffer, size_t count) {
  if (count == kWord && expected_ != Expected::image_version) check_count(buffer);
  if (count != kWord) last_count_ = 0;
  if (count == 1 && expected_ != Expected::image_version && expected_ != Expected::matrix_version) {
    name_length_ = *buffer & static_cast<std::uint8_t>(~kNewFormat);
    expected_ = (*buffer & kNewFormat) != 0 ? Expected::class_name : Expected::zeros;
    return;
  }
  follow_object(buffer, count);
}

void GuardedStream::follow_object(std::uint8_t* buffer, size_t count) {
  switch (std::exchange(expected_, Expected::anything)) {
    case Expected::zeros:
      if (count == 3) expected_ = Expected::class_name;
      break;
    case Expected::class_name:
      if (count == name_length_) {
        // MRPT takes the name as a C string: up to its first zero.
        expected_ = after_class(std::string(buffer, std::find(buffer, buffer + count, 0)));
      }
      break;
    case Expected::image_version:
      replace_image(buffer, count);
      break;
    case Expected::matrix_version:
      expected_ = Expected::rows;
      break;
    case Expected::rows:
      if (count == kWord) {
        rows_ = word_of(buffer);
        expected_ = Expected::columns;
      }
      break;
    case Expected::columns:
      if (count == kWord) check_matrix(word_of(buffer));
      break;
    case Expected::anything:
      break;
  }
}

GuardedStream::Expected GuardedStream::after_class(const std::string& name) {
  if (is_abstract(name))
    throw std::runtime_error("it is a " + name + ", which is no class of objects");
  const auto colon = name.rfind(':');  // newer versions store mrpt::img::CImage
  const std::string bare = colon == std::string::npos ? name : name.substr(colon + 1);
  if (bare == "CPose3DPDFGrid")
    throw std::runtime_error("it is a " + name + ", too large for a rawlog");
  largest_ = bare.find("PDF") == std::string::npos ? kLargestCount : kMostModes;
  if (bare == "CImage") return Expected::image_version;
  return bare.rfind("CMatrix", 0) == 0 ? Expected::matrix_version : Expected::anything;
}

// MRPT gets: version 8, external, the number of the image as its name.
void GuardedStream::replace_image(std::uint8_t* version, size_t count) {
  const std::uint8_t stored = *version;
  images_.push_back(std::make_shared<LogImage>(read_log_image(stream_, stored)));
  const std::string name = std::to_string(images_.size() - 1);
  std::fill(version, version + count, std::uint8_t{0});
  *version = kSubstituteVersion;
  substitute_ = '\1' + little_endian(static_cast<std::uint32_t>(name.size())) + name;
}

void GuardedStream::check_count(std::uint8_t* buffer) {
  const std::uint32_t before = std::exchange(last_count_, 0);
  if (before == kWord && is_text(buffer) && is_for_letters(buffer)) return;
  const std::uint32_t count = word_of(buffer);
  const bool there = count <= kHarmlessCount || (count <= largest_ && stream_.has_bytes(count));
  if (there && std::uint64_t{before} * count <= kLargestCount) {
    last_count_ = count;
  } else {
    std::fill(buffer, buffer + kWord, std::uint8_t{0});
  }
}

// Whether MRPT reads into a string of four letters, not into a count. It counts in local variables;
// a string among them has its own address and length before its letters (libstdc++, short strings).
bool GuardedStream::is_for_letters(const std::uint8_t* buffer) const {
  const auto at = reinterpret_cast<std::uintptr_t>(buffer);
  if (at < stack_address() || at > stack_) return true;  // a field of an object
  std::array<std::uintptr_t, 2> before{};
  std::memcpy(before.data(), buffer - sizeof(before), sizeof(before));
  return before[0] == at && before[1] == kWord;
}

void GuardedStream::check_matrix(std::uint32_t columns) {
  const std::uint64_t elements = std::uint64_t{rows_} * columns;
  const bool there = elements <= kLargestCount && stream_.has_bytes(elements);
  if (!there) throw std::runtime_error("a matrix claims more bytes than the file has");
}

size_t GuardedStream::Write(const void* /*buffer*/, size_t /*count*/) {
  throw std::logic_error("GuardedStream is for reading only");
}

uint64_t GuardedStream::Seek(int64_t /*offset*/, TSeekOrigin /*origin*/) {
  throw std::logic_error("GuardedStream reads forward only");
}

uint64_t GuardedStream::getTotalBytesCount() const {
  return stream_.getTotalBytesCount();
}

uint64_t GuardedStream::getPosition() const {
  return stream_.getPosition();
}

}  // namespace oneac
