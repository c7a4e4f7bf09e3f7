#include "import/made_images.h"

#include "images/image_names.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/error.h"
#include "oneac/base/input_file.h"

#include <system_error>

namespace oneac {
namespace {

namespace fs = std::filesystem;

/// Holds the name of the log that the folder's images are of; beside the folder, in which there are
/// images only.
fs::path mark_of(const fs::path& folder) {
  return folder.parent_path() / ("." + folder.filename().string() + ".oneac-import");
}

bool holds_anything(const fs::path& folder) {
  std::error_code error;
  return fs::is_directory(folder, error) && !fs::is_empty(folder, error) && !error;
}

/// Those of an earlier import of the log, by their mark; without one by the log beside them.
bool are_of(const fs::path& log, const fs::path& folder) {
  constexpr std::size_t kLongest = 4096;
  const std::string marked = beginning_of(mark_of(folder), kLongest);
  std::error_code error;
  return marked.empty() ? fs::exists(log, error) : marked == log.filename().string();
}

/// What an import that was stopped has left: its images, nothing else.
void remove_leftovers(const fs::path& part) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(part, error)) {
    if (entry.is_regular_file(error) && is_image(entry.path())) fs::remove(entry.path(), error);
  }
  fs::remove(part, error);
  if (!fs::exists(part, error)) return;
  throw InputError(part.string(), "is there, where images are put until the log is complete",
                   "take it away, or give another name with -o");
}

}  // namespace

fs::path images_beside(const fs::path& log) {
  return log.parent_path() / (log.stem().string() + "_Images");
}

MadeImages::MadeImages(const fs::path& log) : log_(log), destination_(images_beside(log)) {
  std::error_code error;
  if (holds_anything(destination_) && !are_of(log, destination_)) {
    throw InputError(destination_.string(), "holds files that are not of an import of this log",
                     "take it away, or give another name with -o");
  }
  // A link to a folder of another disk stays one.
  if (fs::is_directory(destination_, error)) destination_ = fs::canonical(destination_);
  part_ = destination_.string() + ".part";
  remove_leftovers(part_);
  require_writable_folder(part_);
}

MadeImages::~MadeImages() {
  std::error_code ignored;
  fs::remove_all(part_, ignored);
}

std::string MadeImages::kept_path(const fs::path& image) const {
  return fs::weakly_canonical(fs::absolute(destination_) / image.filename()).string();
}

void MadeImages::keep() {
  std::error_code error;
  write_file_atomically(mark_of(images_beside(log_)), log_.filename().string());
  if (!fs::exists(destination_, error)) fs::create_directory(destination_, error);
  for (const auto& entry : fs::directory_iterator(part_, error)) {
    const fs::path place = destination_ / entry.path().filename();
    fs::rename(entry.path(), replaced_file(place), error);
    if (error) {
      throw OutputError(place.string(), "cannot be replaced (" + error.message() + ")",
                        "take it away, or give another name with -o");
    }
  }
}

}  // namespace oneac
