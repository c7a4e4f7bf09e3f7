#include "fuzz.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

namespace oneac::fuzz {

std::filesystem::path file_with(std::string_view content) {
  static const int file = ::memfd_create("fuzz", 0);
  static const std::string path = "/proc/self/fd/" + std::to_string(file);
  if (file < 0 || ::ftruncate(file, 0) != 0) throw std::runtime_error("no file in memory");
  std::size_t done = 0;
  while (done < content.size()) {
    const auto at = static_cast<off_t>(done);
    const ssize_t n = ::pwrite(file, content.data() + done, content.size() - done, at);
    if (n <= 0) throw std::runtime_error("a file in memory cannot be written");
    done += static_cast<std::size_t>(n);
  }
  return path;
}

std::uint8_t Numbers::byte() {
  if (data_.empty()) return 0;
  const auto value = static_cast<std::uint8_t>(data_.front());
  data_.remove_prefix(1);
  return value;
}

double Numbers::number() {
  constexpr double kPerUnit = 16384.0;  // 2^14 steps: −2 … 2 in 16 bits
  if (byte() % 2 == 0) {
    const auto low = byte();
    const auto bits = static_cast<std::uint16_t>(low | static_cast<std::uint16_t>(byte() << 8U));
    return static_cast<double>(static_cast<std::int16_t>(bits)) / kPerUnit;
  }
  double value = 0.0;
  char bits[sizeof value] = {};
  const std::size_t n = std::min(sizeof value, data_.size());
  std::memcpy(bits, data_.data(), n);
  data_.remove_prefix(n);
  std::memcpy(&value, bits, sizeof value);
  return value;
}

}  // namespace oneac::fuzz
