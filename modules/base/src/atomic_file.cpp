#include "oneac/base/atomic_file.h"

#include "oneac/base/error.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <ios>
#include <string>
#include <system_error>

namespace oneac {
namespace {

namespace fs = std::filesystem;

fs::path temporary_beside(const fs::path& path) {
  fs::path temporary = path;
  temporary += ".part" + std::to_string(::getpid());
  return temporary;
}

constexpr int kMostLinks = 40;  // Linux follows as many

[[noreturn]] void fail(const fs::path& path, const std::string& fault) {
  throw OutputError(path.string(), fault, "free some space or choose another output folder");
}

/// @throws std::ios_base::failure at the first fault of the disk, errno tells which
void write_through(const fs::path& temporary, const std::function<void(std::ostream&)>& produce) {
  std::ofstream out;
  out.exceptions(std::ios::badbit | std::ios::failbit);
  out.open(temporary, std::ios::binary | std::ios::trunc);
  produce(out);
  out.close();
}

}  // namespace

fs::path replaced_file(const fs::path& path) {
  fs::path file = path;
  std::error_code error;
  for (int links = 0; fs::is_symlink(fs::symlink_status(file, error)); ++links) {
    const fs::path target = fs::read_symlink(file, error);
    if (error || links == kMostLinks) fail(path, "cannot be written (links without an end)");
    file = target.is_absolute() ? target : file.parent_path() / target;
  }
  const fs::file_status status = fs::status(file, error);
  const bool other =
      fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
  if (other) {
    fail(path, "cannot be written (a device, pipe or socket has its name)");
  }
  return file;
}

void write_file_atomically(const fs::path& path, std::string_view content) {
  write_file_atomically(path, [&](std::ostream& out) {
    out.write(content.data(), static_cast<std::streamsize>(content.size()));
  });
}

void write_file_atomically(const fs::path& path,
                           const std::function<void(std::ostream&)>& produce) {
  const fs::path file = replaced_file(path);
  const fs::path temporary = temporary_beside(file);
  std::error_code ignored;
  try {
    write_through(temporary, produce);
  } catch (const std::ios_base::failure&) {
    const std::string reason = std::strerror(errno);
    fs::remove(temporary, ignored);
    fail(path, "cannot be written (" + reason + ")");
  } catch (...) {
    fs::remove(temporary, ignored);
    throw;
  }
  std::error_code error;
  fs::rename(temporary, file, error);
  if (error) {
    fs::remove(temporary, ignored);
    fail(path, "cannot be put in place (" + error.message() + ")");
  }
}

void require_writable_folder(const fs::path& folder) {
  const std::string cure = "choose another folder with -o";
  std::error_code error, reason;
  fs::create_directories(folder, reason);
  if (!fs::is_directory(folder, error)) {
    const std::string why = reason ? " (" + reason.message() + ")" : "";
    throw InputError(folder.string(), "output folder cannot be made" + why, cure);
  }
  const fs::path probe = temporary_beside(folder / "probe");
  const bool writable = static_cast<bool>(std::ofstream(probe));
  fs::remove(probe, error);
  if (!writable) throw InputError(folder.string(), "output folder is not writable", cure);
}

}  // namespace oneac
