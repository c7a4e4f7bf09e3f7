#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <vector>

namespace oneac {

/// Records of one size in a row, more of them than memory should hold: those used last are in
/// memory, the others in a file of `folder` that has no name, so that it is gone with the program
/// however that ends. It is made when the first record has to leave.
///
/// Where it cannot be made, or the disk is full, records stay in memory: none is lost.
/// Reading is thread-safe, adding and changing are not.
class Spool {
 public:
  static constexpr std::size_t kMemory = std::size_t{1} << 20;  ///< [byte] in use at most

  /// @param folder  for the file; "": that for temporary files
  /// @throws std::invalid_argument when record_bytes is 0
  Spool(std::filesystem::path folder, std::size_t record_bytes, std::size_t memory = kMemory);
  ~Spool();
  Spool(Spool&& other) noexcept;
  Spool& operator=(Spool&& other) noexcept;

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t record_bytes() const { return record_bytes_; }
  /// Whether some have left memory.
  [[nodiscard]] bool uses_file() const { return file_ >= 0; }
  void push_back(const std::byte* record);
  /// @throws std::out_of_range; OutputError naming the folder where the file cannot be read
  void read(std::size_t i, std::byte* record) const;
  /// @throws as read()
  void write(std::size_t i, const std::byte* record);

 private:
  /// Neighbours, which come and go together.
  struct Block {
    std::vector<std::byte> bytes;
    bool changed = false;    ///< against the file
    std::uint64_t used = 0;  ///< when it was used last
  };
  [[nodiscard]] std::byte* place(std::size_t i, bool changes) const;
  [[nodiscard]] Block& block(std::size_t number) const;
  void make_room() const;
  [[nodiscard]] bool store(std::size_t number, const Block& block) const;
  void load(std::size_t number, Block& block) const;
  void open_file() const;
  void require_within(std::size_t i) const;
  void close_file();

  std::filesystem::path folder_;
  std::size_t record_bytes_, per_block_, most_blocks_;
  std::size_t size_ = 0;
  // What is where changes by reading, too.
  mutable std::map<std::size_t, Block> blocks_;  ///< in memory
  mutable std::uint64_t uses_ = 0;
  mutable int file_ = -1;
  mutable bool full_ = false;  ///< nothing can leave memory
  mutable std::mutex mutex_;
};

}  // namespace oneac
