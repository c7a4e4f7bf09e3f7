#pragma once

#include "images/log_image.h"
#include "read/decompressing_stream.h"

#include <mrpt/io/CStream.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace oneac {

/// Stands between a file and MRPT's reader of objects, which trusts what it reads: it allocates by
/// a stored count before it reads on, nests as deep as the file says, and hands damaged JPEGs to a
/// libjpeg that ends the program.
///
/// - A count (any four bytes but those of a string of four letters) above kHarmlessCount is checked
///   against the bytes that are left, and read as 0 when there are fewer. The record then fails to
///   parse, or the four bytes were a number that nobody here uses: no class whose content is used
///   stores such a number in four bytes.
/// - A count above kLargestCount is never believed, because an element takes up to 100 bytes of
///   memory for one of the file; in a distribution (500 bytes a mode) none above kMostModes is.
/// - So is the second of two counts, rows and columns, whose product is above kLargestCount.
/// - A matrix may not be larger than the rest of the file.
/// - Images are taken out: MRPT reads an external image whose name is a number, see
///   take_images().
/// - An object of an abstract class ends in an exception: MRPT prints a line of its own about it;
///   so does a CPose3DPDFGrid, which takes a gigabyte when it is made, before anything is read.
/// - A value of which the file has but a part is not there.
/// - Objects nested deeper than kDeepestStack bytes of stack end in an exception.
class GuardedStream : public mrpt::io::CStream {
 public:
  static constexpr std::uint32_t kHarmlessCount = 1U << 16;  ///< elements; never looked at
  static constexpr std::uint32_t kLargestCount = 1U << 22;   ///< elements; four megapixels
  static constexpr std::uint32_t kMostModes = 1U << 20;      ///< elements of a distribution
  static constexpr std::size_t kDeepestStack = std::size_t{1} << 19;  ///< [byte]

  explicit GuardedStream(DecompressingStream& stream) : stream_(stream) {}

  /// To be called before each top-level object.
  void begin_record();
  /// The images of the record that was read.
  [[nodiscard]] LogImages take_images();

  /// @throws std::runtime_error at damage that MRPT would not survive
  size_t Read(void* buffer, size_t count) override;
  size_t Write(const void* buffer, size_t count) override;     ///< @throws std::logic_error always
  uint64_t Seek(int64_t offset, TSeekOrigin origin) override;  ///< @throws std::logic_error always
  [[nodiscard]] uint64_t getTotalBytesCount() const override;
  [[nodiscard]] uint64_t getPosition() const override;

 private:
  enum class Expected { anything, zeros, class_name, image_version, matrix_version, rows, columns };

  void check_depth() const;
  [[nodiscard]] size_t read_substitute(std::uint8_t* buffer, size_t count);
  void follow(std::uint8_t* buffer, size_t count);
  void follow_object(std::uint8_t* buffer, size_t count);
  void replace_image(std::uint8_t* version, size_t count);
  void check_count(std::uint8_t* buffer);
  [[nodiscard]] bool is_for_letters(const std::uint8_t* buffer) const;
  void check_matrix(std::uint32_t columns);
  [[nodiscard]] Expected after_class(const std::string& name);

  DecompressingStream& stream_;
  LogImages images_;
  std::string substitute_;  ///< what MRPT reads next instead of the file
  Expected expected_ = Expected::anything;
  std::size_t name_length_ = 0;
  std::uint32_t rows_ = 0;
  std::uint32_t last_count_ = 0;           ///< what the read before was, if a count
  std::uint32_t largest_ = kLargestCount;  ///< in the object that began last
  std::uintptr_t stack_ = 0;
};

}  // namespace oneac
