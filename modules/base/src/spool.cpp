#include "oneac/base/spool.h"

#include "oneac/base/error.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace oneac {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBlockBytes = std::size_t{32} << 10;  // some dozens of a drive's frames
constexpr std::size_t kFewestBlocks = 2;                    // neighbours across a border

/// A file that nobody else can open. @return its descriptor; -1 where it cannot be made
int nameless_file(const fs::path& folder) {
  constexpr int kOwner = 0600;
#ifdef O_TMPFILE
  const int nameless = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, kOwner);
  if (nameless >= 0) return nameless;
#endif
  std::string name = (folder / ".oneacXXXXXX").string();  // a file system that has no such files
  const int file = ::mkostemp(name.data(), O_CLOEXEC);
  if (file >= 0) ::unlink(name.c_str());
  return file;
}

/// @param transfer  (bytes done so far) → what pread or pwrite answers
/// @return bytes done; fewer than `size` at the end of the file or after a fault, see errno
template <class Transfer>
std::size_t transfer_all(std::size_t size, Transfer&& transfer) {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t part = transfer(done);
    if (part < 0 && errno == EINTR) continue;
    if (part <= 0) break;
    done += static_cast<std::size_t>(part);
  }
  return done;
}

}  // namespace

Spool::Spool(fs::path folder, std::size_t record_bytes, std::size_t memory)
    : folder_(std::move(folder)), record_bytes_(record_bytes) {
  if (record_bytes == 0) throw std::invalid_argument("Spool: record_bytes = 0, must be at least 1");
  const std::size_t block_bytes = std::min(kBlockBytes, memory / kFewestBlocks);
  per_block_ = std::max<std::size_t>(block_bytes / record_bytes, 1);
  most_blocks_ = std::max(memory / (per_block_ * record_bytes), kFewestBlocks);
}

Spool::~Spool() {
  close_file();
}

Spool::Spool(Spool&& other) noexcept
    : folder_(std::move(other.folder_)),
      record_bytes_(other.record_bytes_),
      per_block_(other.per_block_),
      most_blocks_(other.most_blocks_),
      size_(std::exchange(other.size_, 0)),
      blocks_(std::exchange(other.blocks_, {})),
      uses_(other.uses_),
      file_(std::exchange(other.file_, -1)),
      full_(other.full_) {}

Spool& Spool::operator=(Spool&& other) noexcept {
  if (this == &other) return *this;
  close_file();
  folder_ = std::move(other.folder_);
  record_bytes_ = other.record_bytes_;
  per_block_ = other.per_block_;
  most_blocks_ = other.most_blocks_;
  size_ = std::exchange(other.size_, 0);
  blocks_ = std::exchange(other.blocks_, {});
  uses_ = other.uses_;
  file_ = std::exchange(other.file_, -1);
  full_ = other.full_;
  return *this;
}

void Spool::close_file() {
  if (file_ >= 0) ::close(file_);
  file_ = -1;
}

void Spool::push_back(const std::byte* record) {
  const std::lock_guard lock(mutex_);
  std::memcpy(place(size_, true), record, record_bytes_);
  ++size_;
}

void Spool::read(std::size_t i, std::byte* record) const {
  const std::lock_guard lock(mutex_);
  require_within(i);
  std::memcpy(record, place(i, false), record_bytes_);
}

void Spool::write(std::size_t i, const std::byte* record) {
  const std::lock_guard lock(mutex_);
  require_within(i);
  std::memcpy(place(i, true), record, record_bytes_);
}

void Spool::require_within(std::size_t i) const {
  if (i < size_) return;
  throw std::out_of_range("Spool: record " + std::to_string(i) + " of " + std::to_string(size_));
}

std::byte* Spool::place(std::size_t i, bool changes) const {
  Block& found = block(i / per_block_);
  found.used = ++uses_;
  found.changed = found.changed || changes;
  return found.bytes.data() + i % per_block_ * record_bytes_;
}

Spool::Block& Spool::block(std::size_t number) const {
  const auto known = blocks_.find(number);
  if (known != blocks_.end()) return known->second;
  make_room();
  Block fresh;
  fresh.bytes.resize(per_block_ * record_bytes_);
  if (number * per_block_ < size_) load(number, fresh);
  return blocks_.emplace(number, std::move(fresh)).first->second;
}

void Spool::make_room() const {
  if (full_ || blocks_.size() < most_blocks_) return;
  const auto oldest =
      std::min_element(blocks_.begin(), blocks_.end(),
                       [](const auto& a, const auto& b) { return a.second.used < b.second.used; });
  full_ = oldest->second.changed && !store(oldest->first, oldest->second);
  if (!full_) blocks_.erase(oldest);
}

bool Spool::store(std::size_t number, const Block& block) const {
  if (file_ < 0) open_file();
  if (file_ < 0) return false;
  const std::size_t size = block.bytes.size();
  return transfer_all(size, [&](std::size_t done) {
           return ::pwrite(file_, block.bytes.data() + done, size - done,
                           static_cast<off_t>(number * size + done));
         }) == size;
}

void Spool::load(std::size_t number, Block& block) const {
  const std::size_t size = block.bytes.size();
  errno = 0;
  const std::size_t done = transfer_all(size, [&](std::size_t at) {
    return ::pread(file_, block.bytes.data() + at, size - at,
                   static_cast<off_t>(number * size + at));
  });
  if (done == size) return;
  const std::string reason = errno != 0 ? std::strerror(errno) : "it was cut";
  throw OutputError(folder_.string(), "a temporary file in it cannot be read (" + reason + ")",
                    "choose another output folder");
}

void Spool::open_file() const {
  std::error_code ignored;
  file_ = nameless_file(folder_.empty() ? fs::temp_directory_path(ignored) : folder_);
}

}  // namespace oneac
