#pragma once

#include <mrpt/io/CStream.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace oneac {

/// Turns compressed bytes into plain ones, piece by piece.
class Decompressor {
 public:
  struct Piece {
    std::size_t consumed = 0;  ///< bytes of the input
    std::size_t produced = 0;  ///< bytes of the output
    std::string fault;         ///< "" or why the input cannot go on
  };
  virtual ~Decompressor() = default;
  virtual Piece decompress(const std::uint8_t* in, std::size_t in_size, std::uint8_t* out,
                           std::size_t out_size) = 0;
  /// Whether the input may end here: "" or what is missing.
  [[nodiscard]] virtual std::string fault_at_end() const = 0;
  [[nodiscard]] virtual std::string name() const = 0;
};

/// By the magic bytes of the first piece: "gzip", "zstd" or none; also of a file that was packed
/// twice.
[[nodiscard]] std::unique_ptr<Decompressor> make_decompressor(const std::uint8_t* head,
                                                              std::size_t size);

/// A plain, gzip or zstd file as the input of an MRPT archive; tells a clean end from a damaged
/// one. Memory: two fixed buffers, and what is looked ahead at.
class DecompressingStream : public mrpt::io::CStream {
 public:
  /// @throws InputError when the file does not exist, is a folder, cannot be opened or is empty
  explicit DecompressingStream(const std::filesystem::path& file);
  ~DecompressingStream() override;

  /// Fewer bytes than asked for only at the end or at a fault.
  size_t Read(void* buffer, size_t count) override;
  size_t Write(const void* buffer, size_t count) override;     ///< @throws std::logic_error always
  uint64_t Seek(int64_t offset, TSeekOrigin origin) override;  ///< @throws std::logic_error always
  [[nodiscard]] uint64_t getTotalBytesCount() const override;  ///< of the file
  [[nodiscard]] uint64_t getPosition() const override;         ///< in the decompressed data

  /// True when no byte is left, whether cleanly or not.
  [[nodiscard]] bool at_end();
  /// Whether at least so many bytes are left: looks ahead, keeping what it sees.
  [[nodiscard]] bool has_bytes(std::size_t count);
  /// More bytes have been asked for than there are.
  [[nodiscard]] bool ran_out() const { return ran_out_; }
  /// "" or what is wrong with the file, as far as read.
  [[nodiscard]] const std::string& fault() const { return fault_; }
  /// "plain", "gzip" or "zstd".
  [[nodiscard]] const std::string& compression() const { return compression_; }
  /// Share of the file read so far, 0 … 1.
  [[nodiscard]] double progress() const;

 private:
  struct File;
  void refill();
  void read_input();
  [[nodiscard]] std::size_t produce(std::uint8_t* to, std::size_t room);
  [[nodiscard]] std::size_t decompress(std::uint8_t* to, std::size_t room);

  std::unique_ptr<File> file_;
  std::unique_ptr<Decompressor> decompressor_;
  std::string compression_ = "plain";
  std::string fault_;
  std::vector<std::uint8_t> in_;
  std::size_t in_begin_ = 0;
  std::size_t in_end_ = 0;
  std::vector<std::uint8_t> out_;
  std::size_t out_begin_ = 0;
  std::size_t out_end_ = 0;
  std::uint64_t delivered_ = 0;
  bool ended_ = false;
  bool ran_out_ = false;
};

}  // namespace oneac
