#include "oneac/base/input_file.h"

#include "oneac/base/error.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <system_error>
#include <vector>

namespace oneac {
namespace {

namespace fs = std::filesystem;

/// One round of FNV over a word, with the upper bits brought down.
std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) {
  constexpr std::uint64_t kPrime = 0x100000001b3;
  hash = (hash ^ word) * kPrime;
  return hash ^ hash >> 29U;
}

}  // namespace

std::string fault_of_file(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::regular) return "";
  if (status.type() == fs::file_type::not_found) return "no such file";
  if (error) return "cannot be read (" + error.message() + ")";
  if (status.type() == fs::file_type::directory) return "is a folder";
  return "is a pipe, a device or a socket, not a file";
}

std::ifstream open_input(const fs::path& path, const std::string& cure) {
  if (const std::string fault = fault_of_file(path); !fault.empty()) {
    throw InputError(path.string(), fault, cure);
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError(path.string(), "cannot be opened", "check its permissions");
  return stream;
}

std::string content_hash(const fs::path& path) {
  if (!fault_of_file(path).empty()) return "";
  std::ifstream in(path, std::ios::binary);
  if (!in) return "";
  std::uint64_t hash = 0xcbf29ce484222325;
  std::vector<char> block(std::size_t{1} << 20U);
  while (in) {
    std::memset(block.data(), 0, block.size());
    in.read(block.data(), static_cast<std::streamsize>(block.size()));
    const auto count = static_cast<std::size_t>(in.gcount());
    for (std::size_t at = 0; at < count; at += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, block.data() + at, sizeof word);
      hash = mixed(hash, word);
    }
    hash = mixed(hash, count);
  }
  static constexpr std::array<char, 17> kDigits{"0123456789abcdef"};
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4) text += kDigits[hash >> shift & 15U];
  return text;
}

fs::path file_of_program(const std::string& name) {
  std::error_code ignored;
  const fs::path beside = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const fs::path& folder : {beside, beside.parent_path() / "lib" / "oneac"}) {
    fs::path candidate = folder / name;
    if (fault_of_file(candidate).empty()) return candidate;
  }
  return {};
}

}  // namespace oneac
