#include "oneac/base/input_file.h"

#include "oneac/base/error.h"
#include "oneac/base/fingerprint.h"

#include <cstddef>
#include <string_view>
#include <system_error>
#include <vector>

namespace oneac {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNothingThere = "no such file";

}  // namespace

std::string fault_of_file(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::regular) return "";
  if (status.type() == fs::file_type::not_found) return kNothingThere;
  if (error) return "cannot be read (" + error.message() + ")";
  if (status.type() == fs::file_type::directory) return "is a folder";
  return "is a pipe, a device or a socket, not a file";
}

std::string fault_of_place(const fs::path& path) {
  std::string fault = fault_of_file(path);
  return fault == kNothingThere ? "" : fault;
}

bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code missing;
  return a == b || (fs::equivalent(a, b, missing) && !missing);
}

std::string beginning_of(const fs::path& path, std::size_t bytes) {
  if (!fault_of_file(path).empty()) return "";
  std::ifstream in(path, std::ios::binary);
  std::string beginning(bytes, '\0');
  in.read(beginning.data(), static_cast<std::streamsize>(bytes));
  beginning.resize(static_cast<std::size_t>(in.gcount()));
  return beginning;
}

std::ifstream open_input(const fs::path& path, const std::string& cure) {
  if (const std::string fault = fault_of_file(path); !fault.empty()) {
    throw InputError(path.string(), fault, cure);
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError(path.string(), "cannot be opened", "check its permissions");
  return stream;
}

void drop_byte_order_mark(std::string& text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (text.compare(0, kMark.size(), kMark) == 0) text.erase(0, kMark.size());
}

std::string content_hash(const fs::path& path) {
  if (!fault_of_file(path).empty()) return "";
  std::ifstream in(path, std::ios::binary);
  if (!in) return "";
  Fingerprint content;
  std::vector<char> block(std::size_t{1} << 20U);
  while (in) {
    in.read(block.data(), static_cast<std::streamsize>(block.size()));
    content.add(block.data(), static_cast<std::size_t>(in.gcount()));
  }
  return content.text();
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
