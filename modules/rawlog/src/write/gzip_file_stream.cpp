#include "write/gzip_file_stream.h"

#include <zlib.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace oneac {

struct GzipFileStream::File {
  gzFile handle = nullptr;
  ~File() {
    if (handle != nullptr) gzclose(handle);
  }
};

GzipFileStream::GzipFileStream(const std::filesystem::path& file)
    : file_(std::make_unique<File>()) {
  file_->handle = gzopen(file.c_str(), "wb");
  if (file_->handle == nullptr) throw std::runtime_error("the file cannot be made");
}

GzipFileStream::~GzipFileStream() = default;

size_t GzipFileStream::Write(const void* buffer, size_t count) {
  constexpr std::size_t kLargestPiece = std::size_t{1} << 30;  // zlib counts in int
  const auto* bytes = static_cast<const char*>(buffer);
  for (std::size_t done = 0; done < count;) {
    const std::size_t piece = std::min(count - done, kLargestPiece);
    const int written = gzwrite(file_->handle, bytes + done, static_cast<unsigned>(piece));
    if (written <= 0) throw std::runtime_error("the file cannot be written on");
    done += static_cast<std::size_t>(written);
  }
  written_ += count;
  return count;
}

void GzipFileStream::close() {
  if (gzclose(std::exchange(file_->handle, nullptr)) != Z_OK) {
    throw std::runtime_error("the end of the file cannot be written");
  }
}

size_t GzipFileStream::Read(void* /*buffer*/, size_t /*count*/) {
  throw std::logic_error("GzipFileStream is for writing only");
}

uint64_t GzipFileStream::Seek(int64_t /*offset*/, TSeekOrigin /*origin*/) {
  throw std::logic_error("GzipFileStream writes forward only");
}

uint64_t GzipFileStream::getTotalBytesCount() const {
  return written_;
}
uint64_t GzipFileStream::getPosition() const {
  return written_;
}

}  // namespace oneac
