#pragma once

#include <mrpt/io/CStream.h>

#include <cstdint>
#include <filesystem>
#include <memory>

namespace oneac {

/// A gzip file that an MRPT archive writes to, and that tells when the disk is full. (MRPT's own
/// swallows what zlib says when the last bytes do not fit.)
class GzipFileStream : public mrpt::io::CStream {
 public:
  /// @throws std::runtime_error when the file cannot be made
  explicit GzipFileStream(const std::filesystem::path& file);
  ~GzipFileStream() override;

  /// @throws std::runtime_error when not everything could be written
  size_t Write(const void* buffer, size_t count) override;
  /// Writes what is pending. @throws std::runtime_error when that fails
  void close();

  size_t Read(void* buffer, size_t count) override;            ///< @throws std::logic_error always
  uint64_t Seek(int64_t offset, TSeekOrigin origin) override;  ///< @throws std::logic_error always
  [[nodiscard]] uint64_t getTotalBytesCount() const override;  ///< not compressed
  [[nodiscard]] uint64_t getPosition() const override;         ///< not compressed

 private:
  struct File;
  std::unique_ptr<File> file_;
  std::uint64_t written_ = 0;
};

}  // namespace oneac
